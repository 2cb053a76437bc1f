// The title of a species by itself: the words of its photograph's file name.

/** Words of cameras and programs, which say nothing about what is on a photograph. */
const nameless =
    /^(?:\d+|img|image|dsc[a-z]?|pxl|photo|picture|pic|screenshot|pasted|copy|edited|unnamed|untitled|whatsapp|signal|jpe?g|png|webp)$/i;

/** Most letters of a title. */
const longest = 64;

/** Returns the words of a file name as a title; undefined if they say nothing. */
export function titleOfFile(name: string): string | undefined {
    const words = name
        .normalize("NFC")
        .replace(/\.[^.]*$/, "")
        .split(/[^\p{L}\p{N}]+/u)
        .filter((word) => word !== "");
    const saysSomething = words.some((word) => /\p{L}{3}/u.test(word) && !nameless.test(word.replace(/\d+$/, "")));
    const title = words.join(" ").slice(0, longest).trim();
    return saysSomething ? title.charAt(0).toUpperCase() + title.slice(1) : undefined;
}
