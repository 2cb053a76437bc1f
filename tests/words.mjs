// Finds words that were once private to this project where standard terms belong: in comments and names of C++, in the READMEs, and in the
// page's sources. Strings of C++ are not searched, because clients read them.
//   node tests/words.mjs [FILE ...]     all files under version control, or these
// words.txt has a line for each word: a regular expression, the standard term, and after "except" the files where the word means something else.
import { execFileSync } from "node:child_process";
import { existsSync, readFileSync } from "node:fs";

const rules = readFileSync(new URL("words.txt", import.meta.url), "utf8")
    .split("\n")
    .filter((line) => line && !line.startsWith("#"))
    .map((line) => {
        const [word, term, except] = line.split("\t").filter(Boolean);
        return { word: new RegExp(`(?<![\\w-])(?:${word})(?![\\w-])`, "gi"), term, except: except && new RegExp(except.replace(/^except /, "")) };
    });

/** The text of a source without what its strings say; lines stay where they are. */
function searched(file, text) {
    const blank = (found) => found.replace(/[^\n]/g, " ");
    if (/\.(h|cpp|inl)$/.test(file))
        return text.replace(/R"(\w*)\([^]*?\)\1"|"(?:\\.|[^"\\\n])*"|(?<!\d)'(?:\\.|[^'\\\n])+'|\/\/[^\n]*|#include[^\n]*|std::\w+|glm::\w+/g, (found) => (found.startsWith("//") ? found : blank(found)));
    if (/\.(ts|mjs)$/.test(file)) return text.replace(/^import[^\n]*/gm, blank);
    return text.replace(/`[^`\n]*`|```[^]*?```/g, blank);
}

const files = process.argv.length > 2
    ? process.argv.slice(2)
    : execFileSync("git", ["-c", "safe.directory=*", "ls-files", "-co", "--exclude-standard"], { encoding: "utf8" }).split("\n");
let found = 0;
for (const file of files) {
    if (!/^(core|api|server|tests|web_viewer)\/.*\.(h|cpp|inl|ts|html|css)$|(^|\/)README\.md$/.test(file) || !existsSync(file)) continue;
    searched(file, readFileSync(file, "utf8")).split("\n").forEach((line, i) => {
        // A name is looked at word by word: `kept_key` and `KeptKey` have two.
        const words = line.replace(/([a-z0-9])([A-Z])/g, "$1 $2").replace(/_/g, " ");
        for (const { word, term, except } of rules) {
            if (except?.test(file)) continue;
            for (const [bad] of words.matchAll(word)) {
                console.log(`${file}:${i + 1}: "${bad}": ${term}`);
                ++found;
            }
        }
    });
}
console.log(`${found} words of before`);
process.exit(found > 0 ? 1 : 0);
