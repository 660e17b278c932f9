// Sets TeX, a request a line: {"tex", "display"} in, {"html"} or {"error"} out. Ends with its input.
import { createRequire } from "node:module";
import readline from "node:readline";

const katex = createRequire(process.argv[2] + "/")("katex");

function answer({ tex, display }) {
  try {
    const options = { displayMode: display, throwOnError: true, strict: "error", output: "htmlAndMathml" };
    return { html: katex.renderToString(tex, options) };
  } catch (error) {
    return { error: String(error.message) };
  }
}

readline.createInterface({ input: process.stdin }).on("line", (line) => {
  process.stdout.write(JSON.stringify(answer(JSON.parse(line))) + "\n");
});
