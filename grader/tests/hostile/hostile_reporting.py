"""Submissions whose names and words are meant for whoever reads the reports."""

from __future__ import annotations

from hostile_case import RIGHT, WRONG, Case, Expect, before_main, text

HARMLESS = Expect("pass", "PPPPP")
WORDY = Expect("fail", "Pffuf")

EVIL = "<raybook-evil onclick='alert(1)'></pre></td><script>raybookEvil()</script>"

CASES = [
    Case(
        "<raybook-evil onclick='alert(1)'>",
        "an id that is HTML",
        HARMLESS,
        write=text(RIGHT),
        quick=True,
    ),
    Case(
        '=HYPERLINK("evil","marks")',
        "an id that is a formula",
        HARMLESS,
        write=text(RIGHT),
        quick=True,
    ),
    Case("@SUM(1+1)*cmd|' -C calc'!A0", "another formula", HARMLESS, write=text(RIGHT)),
    Case(
        "\x1b[2J\x1b]0;evil\x07cleared",
        "an id that clears the terminal",
        HARMLESS,
        write=text(RIGHT),
        quick=True,
    ),
    Case(
        "[bold red]evil[reverse]",
        "an id in the terminal library's own language",
        HARMLESS,
        write=text(RIGHT),
    ),
    Case("{{ 7 * 7 }}{% raw %}", "an id in the templates' language", HARMLESS, write=text(RIGHT)),
    Case(
        "two\nlines\u202egnp.exe",
        "an id of two lines that reads backwards",
        HARMLESS,
        write=text(RIGHT),
    ),
    Case("bad-\udcff-utf8", "an id that is no UTF-8", HARMLESS, write=text(RIGHT)),
    Case("n" * 250, "an id of 250 characters", HARMLESS, write=text(RIGHT)),
    Case("--fresh", "an id that looks like an option", HARMLESS, write=text(RIGHT)),
    Case(
        "html-error",
        "HTML in the compiler's words",
        Expect("build-error", "b----", "does not compile"),
        write=text(f"{WRONG}\n#error {EVIL.replace(chr(39), '')} &amp; {{{{ 7 * 7 }}}}\n"),
        quick=True,
    ),
    Case(
        "html-words",
        "HTML and a script in what the tests print",
        WORDY.saying("tests fail"),
        write=before_main(f'puts("{EVIL}");'),
    ),
    Case(
        "terminal-words",
        "terminal codes, bidi marks and nulls in what the tests print",
        WORDY.saying("tests fail"),
        write=before_main(
            r'const char said[] = "\033[31m\033]0;evil\007\0\b\u202e\xff\xc0";'
            "\nfwrite(said, 1, sizeof said, stdout);"
        ),
    ),
    Case(
        "giant-line",
        "a line of 200,000 characters",
        WORDY.saying("tests fail"),
        write=before_main("for (int i = 0; i < 200000; i++)\n    putchar('x');"),
    ),
    Case(
        "html-test-names",
        "test results whose names are HTML",
        WORDY,
        write=before_main('puts("a.c:1:<raybook-evil onclick=x>:FAIL: =cmd|evil");'),
    ),
]
