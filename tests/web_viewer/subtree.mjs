// Reads subtrees of 3D Tiles 1.1 as this server writes them: every tile is there and has its box as metadata.

/** Returns the number of a tile in its subtree: levels one after another, each in the order of a Z-order curve. */
export function numberInSubtree(level, x, y) {
    let code = 0;
    for (let bit = 0; bit < level; ++bit) code += (((x >> bit) & 1) + 2 * ((y >> bit) & 1)) * 4 ** bit;
    return (4 ** level - 1) / 3 + code;
}

/**
 * Returns the box of a tile in a subtree: east, north and up, from the centre of the world.
 *
 * @param {Uint8Array} bytes of the subtree
 * @param {number} number of the tile in it
 */
export function boxInSubtree(bytes, number) {
    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    const length = Number(view.getBigUint64(8, true));
    const json = JSON.parse(new TextDecoder().decode(bytes.subarray(24, 24 + length)));
    const { values } = json.propertyTables[json.tileMetadata].properties.boundingBox;
    const { byteOffset } = json.bufferViews[values];
    const at = (i) => view.getFloat64(24 + length + byteOffset + 8 * (12 * number + i), true);
    const [middle, half] = [[0, 1, 2].map(at), [3, 7, 11].map(at)];
    return { min: middle.map((value, i) => value - half[i]), max: middle.map((value, i) => value + half[i]) };
}
