// Depth of field of a real lens: the mean of many pictures, each seen from another point of the
// aperture, all of which agree at the depth of the focus. Blur by a filter would need the depth of
// every transparent pixel, and would show halos at edges.
import {
    AddEquation,
    CustomBlending,
    FloatType,
    FramebufferTexture,
    Mesh,
    NearestFilter,
    NoBlending,
    OneFactor,
    OrthographicCamera,
    PlaneGeometry,
    ShaderMaterial,
    Vector2,
    Vector3,
    WebGLRenderTarget,
    type PerspectiveCamera,
    type Scene,
    type WebGLRenderer,
} from "three";

/** Stops of the lens. */
export const fNumbers = [1.4, 2, 2.8, 4, 5.6, 8, 11, 16, 22] as const;
export type FNumber = (typeof fNumbers)[number];
export const usualFNumber: FNumber = 4;

/** Height of the sensor, metres: full frame. With the camera's angle it gives the focal length. */
const sensorHeight = 0.024;
/** Pictures of which the final one is the mean, and how many of them are drawn at once. */
const samples = 64;
export const samplesAtOnce = 8;

const vertexShader = `
varying vec2 at;
void main() {
    at = uv;
    gl_Position = vec4(position.xy, 0.0, 1.0);
}`;

// Light is averaged, not the numbers of the screen.
const addShader = `
uniform sampler2D image;
varying vec2 at;
void main() {
    vec3 shown = texture2D(image, at).rgb;
    vec3 low = shown / 12.92;
    vec3 high = pow((shown + 0.055) / 1.055, vec3(2.4));
    gl_FragColor = vec4(mix(high, low, vec3(lessThanEqual(shown, vec3(0.04045)))), 1.0);
}`;

const meanShader = `
uniform sampler2D image;
varying vec2 at;
void main() {
    vec4 sum = texture2D(image, at);
    vec3 light = sum.rgb / max(sum.a, 1.0);
    vec3 low = light * 12.92;
    vec3 high = 1.055 * pow(light, vec3(1.0 / 2.4)) - 0.055;
    gl_FragColor = vec4(mix(high, low, vec3(lessThanEqual(light, vec3(0.0031308)))), 1.0);
}`;

/** Returns the diameter of the aperture, metres, of a lens with a vertical angle, degrees. */
export function apertureDiameter(fNumber: number, angle: number): number {
    return sensorHeight / (2 * Math.tan((angle * Math.PI) / 360)) / fNumber;
}

/** Returns a point of the unit disc, the first one near its centre; all are evenly spread. */
export function discPoint(index: number, count: number): [number, number] {
    const radius = Math.sqrt((index + 0.5) / count);
    const angle = index * Math.PI * (3 - Math.sqrt(5));
    return [radius * Math.cos(angle), radius * Math.sin(angle)];
}

/** Moves the camera in the plane of the lens by metres, so that what is `focus` metres away stays
 *  where it is in the picture. */
export function shiftLens(camera: PerspectiveCamera, x: number, y: number, focus: number): void {
    const right = new Vector3().setFromMatrixColumn(camera.matrixWorld, 0);
    const up = new Vector3().setFromMatrixColumn(camera.matrixWorld, 1);
    camera.position.addScaledVector(right, x).addScaledVector(up, y);
    const { elements } = camera.projectionMatrix;
    elements[8] = (elements[8] ?? 0) - ((elements[0] ?? 0) * x) / focus;
    elements[9] = (elements[9] ?? 0) - ((elements[5] ?? 0) * y) / focus;
    camera.projectionMatrixInverse.copy(camera.projectionMatrix).invert();
}

export class DepthOfField {
    private drawn = 0;
    private readonly size = new Vector2();
    private picture: FramebufferTexture | undefined;
    private sum: WebGLRenderTarget | undefined;
    private readonly sheet = new Mesh(new PlaneGeometry(2, 2));
    private readonly sheetCamera = new OrthographicCamera(-1, 1, 1, -1, 0, 1);
    private readonly add = new ShaderMaterial({
        uniforms: { image: { value: null } },
        vertexShader,
        fragmentShader: addShader,
        blending: CustomBlending,
        blendEquation: AddEquation,
        blendSrc: OneFactor,
        blendDst: OneFactor,
        depthTest: false,
        depthWrite: false,
    });
    private readonly mean = new ShaderMaterial({
        uniforms: { image: { value: null } },
        vertexShader,
        fragmentShader: meanShader,
        blending: NoBlending,
        depthTest: false,
        depthWrite: false,
    });

    constructor(private readonly renderer: WebGLRenderer) {
        this.sheet.frustumCulled = false;
    }

    /** Returns true if the graphics card can add up pictures. */
    get possible(): boolean {
        const { extensions } = this.renderer;
        return extensions.has("EXT_color_buffer_float") && extensions.has("EXT_float_blend");
    }

    /** Begins a new picture: something has changed. */
    restart(): void {
        this.drawn = 0;
    }

    /** Draws some more of the pictures, and their mean on the canvas; returns true if it is the
     *  final one.
     *
     *  @param focus distance from the camera of what is sharp, metres */
    advance(
        scene: Scene,
        camera: PerspectiveCamera,
        fNumber: number,
        focus: number,
        count = samplesAtOnce,
    ): boolean {
        this.fitCanvas();
        const { renderer, picture, sum } = this;
        if (!picture || !sum) return true;
        const { autoClear } = renderer;
        const { autoUpdate } = renderer.shadowMap;
        if (this.drawn === 0) {
            renderer.setRenderTarget(sum);
            renderer.clear();
            renderer.setRenderTarget(null);
        }
        const radius = apertureDiameter(fNumber, camera.fov) / 2;
        const position = camera.position.clone();
        const projection = camera.projectionMatrix.clone();
        camera.updateMatrixWorld();
        const last = Math.min(this.drawn + count, samples);
        for (; this.drawn < last; ++this.drawn) {
            const [x, y] = discPoint(this.order(this.drawn), samples);
            shiftLens(camera, x * radius, y * radius, focus);
            renderer.autoClear = true;
            renderer.render(scene, camera);
            renderer.shadowMap.autoUpdate = false;
            camera.position.copy(position);
            camera.projectionMatrix.copy(projection);
            renderer.copyFramebufferToTexture(picture);
            renderer.autoClear = false;
            this.pass(this.add, sum);
        }
        camera.projectionMatrixInverse.copy(projection).invert();
        camera.updateMatrixWorld();
        renderer.shadowMap.autoUpdate = autoUpdate;
        this.mean.uniforms["image"]!.value = sum.texture;
        this.pass(this.mean, null);
        renderer.autoClear = autoClear;
        return this.drawn >= samples;
    }

    /** Draws the whole picture. */
    complete(scene: Scene, camera: PerspectiveCamera, fNumber: number, focus: number): void {
        this.restart();
        this.advance(scene, camera, fNumber, focus, samples);
    }

    /** Frees the memory on the graphics card; it is taken again with the next picture. */
    dispose(): void {
        this.picture?.dispose();
        this.sum?.dispose();
        this.picture = undefined;
        this.sum = undefined;
        this.drawn = 0;
    }

    /** Returns which point of the disc is next: the first ones are spread over all of it. */
    private order(index: number): number {
        return (index * 37) % samples;
    }

    private fitCanvas(): void {
        const { width, height } = this.renderer.getDrawingBufferSize(this.size);
        if (this.sum?.width === width && this.sum.height === height) return;
        this.dispose();
        this.picture = new FramebufferTexture(width, height);
        this.add.uniforms["image"]!.value = this.picture;
        this.sum = new WebGLRenderTarget(width, height, {
            type: FloatType,
            minFilter: NearestFilter,
            magFilter: NearestFilter,
            depthBuffer: false,
        });
    }

    private pass(material: ShaderMaterial, target: WebGLRenderTarget | null): void {
        this.sheet.material = material;
        this.renderer.setRenderTarget(target);
        this.renderer.render(this.sheet, this.sheetCamera);
        this.renderer.setRenderTarget(null);
    }
}
