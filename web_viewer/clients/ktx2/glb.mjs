// Reads a GLB, replaces its images by KTX2 files, and writes it with everything else as it was:
// members and extensions that this program does not know, compressed geometry, names and extras.

/** A file that cannot be converted; the message says why, and what to do. */
export class Unusable extends Error {}

const magic = 0x46546c67;
const chunkTypes = { json: 0x4e4f534a, binary: 0x004e4942 };
/** Extensions of buffer views with compressed bytes in a buffer of their own. */
const compressions = ["EXT_meshopt_compression", "KHR_meshopt_compression"];
/** Extensions of textures with an image in another format. */
const formats = ["EXT_texture_webp", "EXT_texture_avif"];
const basis = "KHR_texture_basisu";
/** Names of textures that hold colours; all others hold numbers. */
const colours =
    /^(baseColor|emissive|(sheen|specular|diffuseTransmission)Color|diffuse|specularGlossiness)Texture$/;

/** Returns the JSON and the binary chunk of a GLB. */
export function readGlb(bytes) {
    const fits = (at, size) => at + size <= bytes.length;
    if (!fits(0, 20) || bytes.readUInt32LE(0) !== magic || bytes.readUInt32LE(4) !== 2)
        throw new Unusable("is no GLB of version 2");
    let json;
    let binary = Buffer.alloc(0);
    for (let at = 12; fits(at, 8);) {
        const size = bytes.readUInt32LE(at);
        const type = bytes.readUInt32LE(at + 4);
        if (!fits(at + 8, size)) throw new Unusable("is cut off");
        const body = bytes.subarray(at + 8, at + 8 + size);
        if (type === chunkTypes.json && json === undefined) json = body;
        if (type === chunkTypes.binary) binary = body;
        at += 8 + size;
    }
    if (json === undefined) throw new Unusable("has no JSON chunk");
    try {
        return { json: JSON.parse(json.toString("utf8")), binary };
    } catch {
        throw new Unusable("has a JSON chunk that is no JSON");
    }
}

/** Returns a GLB of JSON and a binary chunk. */
export function writeGlb(json, binary) {
    const padded = (body, fill) =>
        Buffer.concat([body, Buffer.alloc((4 - (body.length % 4)) % 4, fill)]);
    const chunks = [
        [chunkTypes.json, padded(Buffer.from(JSON.stringify(json)), 0x20)],
        [chunkTypes.binary, padded(binary, 0)],
    ].map(([type, body]) => {
        const head = Buffer.alloc(8);
        head.writeUInt32LE(body.length, 0);
        head.writeUInt32LE(type, 4);
        return Buffer.concat([head, body]);
    });
    const head = Buffer.alloc(12);
    head.writeUInt32LE(magic, 0);
    head.writeUInt32LE(2, 4);
    head.writeUInt32LE(12 + chunks[0].length + chunks[1].length, 8);
    return Buffer.concat([head, ...chunks]);
}

/** Calls `visit` with the name and index of every texture that a part of a material names. */
function eachTexture(part, visit) {
    for (const [name, value] of Object.entries(part ?? {})) {
        if (typeof value !== "object" || value === null) continue;
        if (/Texture$/.test(name) && Number.isInteger(value.index)) visit(name, value.index);
        eachTexture(value, visit);
    }
}

/** Returns what the images of the textures hold, by index of the texture: "colour", "normal" or
 *  "data". */
function rolesOf(json) {
    const roles = new Map();
    for (const material of json.materials ?? [])
        eachTexture(material, (name, index) => {
            const role = colours.test(name)
                ? "colour"
                : /ormalTexture$/.test(name)
                  ? "normal"
                  : "data";
            const before = roles.get(index) ?? role;
            if ((before === "colour") !== (role === "colour"))
                throw new Unusable(`uses texture ${index} both as a colour and as data`);
            // Numbers beside a normal are compressed as carefully as the normal.
            roles.set(index, [before, role].includes("normal") ? "normal" : role);
        });
    return roles;
}

/** Returns the image of a texture in the format with the least loss: JPEG or PNG, else WebP. */
function sourceOf(texture) {
    const others = formats.map((name) => texture.extensions?.[name]?.source);
    return texture.source ?? others.find((source) => source !== undefined);
}

/** Returns the images of a GLB that textures use, each once for what it holds: its bytes, its role,
 *  and the indices of the textures. */
export function imagesOf({ json, binary }) {
    const roles = rolesOf(json);
    const images = new Map();
    for (const [index, texture] of (json.textures ?? []).entries()) {
        if (texture.extensions?.[basis]) throw new Unusable("has KTX2 images already");
        const source = sourceOf(texture);
        const image = json.images?.[source];
        if (!image) throw new Unusable(`has no image for texture ${index}`);
        if (image.bufferView === undefined)
            throw new Unusable(
                `links to the image ${String(image.uri).slice(0, 80)}; ask for textures=embedded`,
            );
        const { buffer, byteOffset = 0, byteLength } = json.bufferViews?.[image.bufferView] ?? {};
        if (buffer !== 0 || byteOffset + byteLength > binary.length)
            throw new Unusable(`has image ${source} outside its binary chunk`);
        const role = roles.get(index) ?? "colour";
        const key = `${source} ${role}`;
        const found = images.get(key) ?? {
            bytes: binary.subarray(byteOffset, byteOffset + byteLength),
            name: image.name,
            role,
            textures: [],
        };
        found.textures.push(index);
        images.set(key, found);
    }
    if (images.size === 0)
        throw new Unusable("has no images; ask for textures=embedded, or leave it as it is");
    return [...images.values()];
}

/**
 * Returns the GLB with other images.
 *
 * images  those of imagesOf(), each with `ktx2`, the bytes that replace it
 */
export function withImages({ json, binary }, images) {
    const out = structuredClone(json);
    const ofImages = new Set(out.images.map(({ bufferView }) => bufferView));
    const parts = [];
    let size = 0;
    const append = (bytes) => {
        const gap = (4 - (size % 4)) % 4;
        parts.push(Buffer.alloc(gap), bytes);
        const at = size + gap;
        size = at + bytes.length;
        return at;
    };
    const moved = (place) => {
        const { byteOffset = 0, byteLength } = place;
        if (byteOffset + byteLength > binary.length) throw new Unusable("is cut off");
        place.byteOffset = append(binary.subarray(byteOffset, byteOffset + byteLength));
    };
    // Views keep their order and get new indices, because those of images leave.
    const newIndex = new Map();
    const views = [];
    for (const [index, view] of out.bufferViews.entries()) {
        if (ofImages.has(index)) continue;
        newIndex.set(index, views.length);
        views.push(view);
        if (view.buffer === 0) moved(view);
        for (const name of compressions)
            if (view.extensions?.[name]?.buffer === 0) moved(view.extensions[name]);
    }
    renumberViews(out, newIndex);
    out.bufferViews = views;
    out.images = images.map(({ name, ktx2 }) => {
        views.push({ buffer: 0, byteOffset: append(ktx2), byteLength: ktx2.length });
        return { ...(name && { name }), mimeType: "image/ktx2", bufferView: views.length - 1 };
    });
    out.buffers[0].byteLength = size;
    for (const [source, { textures }] of images.entries())
        for (const index of textures) {
            const { source: _, extensions = {}, ...texture } = out.textures[index];
            for (const name of formats) delete extensions[name];
            out.textures[index] = {
                ...texture,
                extensions: { ...extensions, [basis]: { source } },
            };
        }
    for (const list of ["extensionsUsed", "extensionsRequired"]) {
        const others = (out[list] ?? []).filter((name) => !formats.includes(name));
        out[list] = [...others, basis];
    }
    return writeGlb(out, Buffer.concat(parts));
}

/** Replaces the index in every member called `bufferView`. */
function renumberViews(part, newIndex) {
    for (const [name, value] of Object.entries(part ?? {})) {
        if (name === "bufferView" && newIndex.has(value)) part[name] = newIndex.get(value);
        else if (typeof value === "object" && name !== "images" && name !== "extras")
            renumberViews(value, newIndex);
    }
}
