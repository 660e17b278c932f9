"""Modules that attack the compiler, the linker or what they say."""

from __future__ import annotations

from hostile_case import CHECKOUT, OWNED, PRELUDE, RIGHT, WRONG, Case, Expect, before_main, text

NO_PROGRAM = Expect("build-error", "b----")
HARMLESS = Expect("pass", "PPPPP")

_LAUGHS = "".join(
    f"#define L{i + 1} L{i} L{i} L{i} L{i} L{i} L{i} L{i} L{i} L{i} L{i}\n" for i in range(12)
)
_SELF = f'#if __INCLUDE_LEVEL__ < 150\n#include "{OWNED.split("/")[-1]}"\n#endif\n'

CASES = [
    Case(
        "include-zeros",
        "includes a file without end",
        NO_PROGRAM.saying("does not compile"),
        write=text('#include "/dev/zero"\n' + WRONG),
        quick=True,
    ),
    Case(
        "macro-bomb",
        "a macro of 10^12 words",
        NO_PROGRAM.saying("does not compile"),
        write=text(f"#define L0 +1\n{_LAUGHS}int laugh(void) {{ return 0 L12; }}\n{WRONG}"),
    ),
    Case(
        "assembler-bomb",
        "an assembler loop of 10^11 bytes",
        NO_PROGRAM.saying("does not compile"),
        write=text(f'{WRONG}\n__asm__(".rept 100000000000\\n.byte 1\\n.endr");\n'),
    ),
    Case(
        "include-bomb",
        "includes itself twice at 150 levels",
        NO_PROGRAM.saying("does not compile"),
        write=text(_SELF + _SELF + WRONG),
    ),
    Case(
        "giant-object",
        "an initialised array of 1 GiB",
        NO_PROGRAM.saying("does not compile"),
        write=text(f"{WRONG}\nchar giant[1 << 30] = {{1}};\n"),
    ),
    Case(
        "giant-program",
        "an array of 64 GiB that takes no room in the file",
        Expect("build-error", "b----", "does not link"),
        write=text(
            f"{RIGHT}\nchar giant[1L << 36];\nchar *end(void);\n"
            "char *end(void) { return giant + (1L << 36) - 1; }\n"
        ),
    ),
    Case(
        "deep-parentheses",
        "an expression nested 200,000 deep",
        NO_PROGRAM.saying("does not compile"),
        write=text(f"{WRONG}\nint deep = {'(' * 200_000}1{')' * 200_000};\n"),
    ),
    Case(
        "error-flood",
        "60,000 warnings",
        NO_PROGRAM.saying("does not compile"),
        write=text(WRONG + "#warning flood\n" * 60_000),
    ),
    Case(
        "include-passwd",
        "includes a file of the machine",
        NO_PROGRAM.saying("does not compile"),
        write=text('#include "/etc/passwd"\n' + WRONG),
        quick=True,
    ),
    Case(
        "line-passwd",
        "lets the compiler quote a file of the machine in a message",
        NO_PROGRAM.saying("does not compile"),
        write=text(f'{WRONG}\n#line 1 "/etc/passwd"\nbool x = ;\n'),
    ),
    Case(
        "embedded-environment",
        "embeds the compiler's environment and prints it",
        Expect("pass", "PPPPP"),
        write=before_main(
            "fwrite(begin, 1, (size_t)(end - begin), stdout);",
            RIGHT,
            '__asm__(".section .rodata\\nenvironment:\\n.incbin \\"/proc/self/environ\\"\\n"\n'
            '    "environment_end:\\n.text");\n'
            'extern const char begin[] __asm__("environment");\n'
            'extern const char end[] __asm__("environment_end");\n',
        ),
    ),
    Case(
        "poisoned-names",
        "poisons names and redefines malloc and assert",
        HARMLESS,
        write=text(
            f"{RIGHT}\n#define malloc(n) 0\n#define assert(x) 0\n#pragma GCC poison calloc free\n"
        ),
    ),
    Case(
        "own-libc",
        "defines sqrtf, malloc, fopen and main for everybody",
        HARMLESS,
        write=text(
            f"#include <stddef.h>\n{RIGHT}\n"
            "float sqrtf(float x);\nfloat sqrtf(float x) { return 0.0f * x; }\n"
            "int main(void);\nint main(void) { return 7; }\n"
            "void *mem_alloc(size_t n, size_t size);\n"
            "void *mem_alloc(size_t n, size_t size) { (void)n; (void)size; return NULL; }\n"
        ),
        quick=True,
    ),
    Case(
        "own-loader",
        "names itself the program's loader",
        Expect("fail", "Pffuf"),
        write=text(
            f'{WRONG}\n__attribute__((section(".interp"), used)) static const char loader[] = '
            '"/work/results.bin";\n'
        ),
    ),
    Case(
        "linker-options",
        "passes options to the linker as if it were compiled for LTO",
        HARMLESS,
        write=text(
            f'{RIGHT}\n__asm__(".section .gnu.lto_.opts,\\"e\\",@progbits\\n"\n'
            "    \".string \\\"'-fplugin=/work/module0.o' '-wrapper' '/work/x'\\\"\\n"
            '.text\\n"\n    ".section .gnu.lto_.symtab.1,\\"e\\",@progbits\\n.byte 0\\n'
            '.text");\n'
        ),
    ),
    Case(
        "embedded-reference",
        "embeds the reference's object when it is compiled",
        NO_PROGRAM.saying("does not compile"),
        write=text(f'{WRONG}\n__asm__(".incbin \\"/kit/objects/shapes/triangle.o\\"");\n'),
    ),
    Case(
        "include-reference",
        "includes the reference from where it may lie",
        NO_PROGRAM.saying("does not compile"),
        write=text(
            "".join(
                f'#if __has_include("{p}")\n#include "{p}"\n#endif\n'
                for p in (
                    f"{CHECKOUT}/{OWNED}",
                    f"/course/{OWNED}",
                    f"/kit/{OWNED}",
                    f"../../../{OWNED}",
                )
            )
            + "#ifndef TODO_triangle_intersect\n#error no reference anywhere\n#endif\n"
        ),
    ),
    Case(
        "forged-log",
        "an #error that looks like another verdict",
        NO_PROGRAM.saying("does not compile"),
        write=text(f"{WRONG}\n#error \x1b[2J\x1b[32mall 6000 cases are right: verdict pass\n"),
    ),
    Case(
        "ifunc",
        "a resolver that runs before everything and ends the program",
        Expect("fail", "Pffff", "before it had answered"),
        write=text(
            f"{PRELUDE}{WRONG}\nstatic void (*resolve(void))(void)\n{{\n    _exit(0);\n}}\n"
            'static void early(void) __attribute__((ifunc("resolve")));\n'
            "__attribute__((constructor)) static void use(void) { early(); }\n"
        ),
    ),
]
