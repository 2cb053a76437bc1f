// A picture that is larger than the stage: drawn in tiles, each as large as the canvas, so that the
// graphics card needs no more memory than for the stage.
import type { PerspectiveCamera } from "three";

/** Draws a part of the whole picture on the canvas: left, top, width and height as fractions. */
export type DrawTile = (tile: readonly [number, number, number, number]) => void;

/** Returns a PNG `scale` times as large as the canvas. All tiles are drawn within one task, in
 *  which `restore` draws the stage again, so that none is seen on the page. Throws an error that
 *  says so if the browser or the graphics card does not manage the size. */
export async function snapshot(
    canvas: HTMLCanvasElement,
    camera: PerspectiveCamera,
    scale: number,
    drawTile: DrawTile,
    restore: () => void,
): Promise<Blob> {
    const { width, height } = canvas;
    const sheet = document.createElement("canvas");
    sheet.width = width * scale;
    sheet.height = height * scale;
    const refused = new Error(
        `The graphics card or the browser makes no picture of ${sheet.width} × ` +
            `${sheet.height} pixels. Make the window smaller and try again.`,
    );
    const context = sheet.getContext("2d");
    if (!context) throw refused;
    try {
        for (let row = 0; row < scale; ++row) {
            for (let column = 0; column < scale; ++column) {
                const [x, y] = [column * width, row * height];
                camera.setViewOffset(sheet.width, sheet.height, x, y, width, height);
                drawTile([column / scale, row / scale, 1 / scale, 1 / scale]);
                context.drawImage(canvas, x, y);
            }
        }
    } finally {
        camera.clearViewOffset();
        restore();
    }
    const gl = canvas.getContext("webgl2");
    if (!gl || gl.isContextLost() || gl.getError() === gl.OUT_OF_MEMORY) throw refused;
    const picture = await new Promise<Blob | null>((resolve) => sheet.toBlob(resolve));
    if (!picture) throw refused;
    return picture;
}
