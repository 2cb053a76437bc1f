// The ground of the stage: a sheet with ruled lines that fades out, and the sun's shadow on it.
// Both face upwards only, so that a view from below shows the mushroom alone.
import {
    CircleGeometry,
    Color,
    Group,
    Mesh,
    MeshBasicMaterial,
    ShaderMaterial,
    ShadowMaterial,
    type ColorRepresentation,
} from "three";

const vertexShader = `
varying vec2 at;
void main() {
    vec4 place = modelMatrix * vec4(position, 1.0);
    at = place.xz;
    gl_Position = projectionMatrix * viewMatrix * place;
}`;

const fragmentShader = `
uniform float spacing;
uniform float reach;
uniform vec3 ink;
varying vec2 at;
float lines(float every, float width) {
    vec2 cell = at / every;
    vec2 thin = fwidth(cell);
    vec2 far = abs(fract(cell - 0.5) - 0.5);
    vec2 line = 1.0 - smoothstep(thin * width * 0.5, thin * (width * 0.5 + 1.0), far);
    vec2 dense = clamp(1.0 - thin * 2.5, 0.0, 1.0);
    return max(line.x * dense.x, line.y * dense.y);
}
void main() {
    float ruled = max(0.10 * lines(spacing, 0.0), 0.20 * lines(spacing * 5.0, 0.2));
    float fade = 1.0 - smoothstep(reach * 0.1, reach, length(at));
    gl_FragColor = vec4(ink, ruled * fade);
    #include <colorspace_fragment>
}`;

export class Ground extends Group {
    private readonly ruling = new ShaderMaterial({
        uniforms: { spacing: { value: 0.01 }, reach: { value: 1 }, ink: { value: new Color() } },
        vertexShader,
        fragmentShader,
        transparent: true,
        depthWrite: false,
    });
    private readonly shade = new ShadowMaterial({
        opacity: 0.26,
        transparent: true,
        depthWrite: false,
    });
    private readonly ruled: Mesh;
    private readonly shadowed: Mesh;

    constructor() {
        super();
        const disc = new CircleGeometry(1, 64).rotateX(-Math.PI / 2);
        this.ruled = new Mesh(disc, this.ruling);
        const shadow = new Mesh(disc, this.shade);
        shadow.receiveShadow = true;
        this.ruled.renderOrder = -2;
        shadow.renderOrder = -1;
        // Parts below the ground are hidden from above, and visible from below.
        const earth = new Mesh(
            disc,
            new MeshBasicMaterial({
                colorWrite: false,
                polygonOffset: true,
                polygonOffsetFactor: 2,
                polygonOffsetUnits: 8,
            }),
        );
        earth.renderOrder = -3;
        this.shadowed = shadow;
        this.add(earth, this.ruled, shadow);
    }

    /** Fits the sheet to a model: `radius` in metres, lines every `spacing` metres. */
    fit(radius: number, spacing: number): void {
        this.scale.setScalar(radius * 9);
        this.ruling.uniforms["spacing"]!.value = spacing;
        this.ruling.uniforms["reach"]!.value = radius * 4;
    }

    colours(ink: ColorRepresentation, shadow: ColorRepresentation): void {
        (this.ruling.uniforms["ink"]!.value as Color).set(ink);
        this.shade.color.set(shadow);
    }

    /** Makes the ground invisible; it still hides what is below it. */
    makeInvisible(): void {
        this.ruled.visible = false;
        this.shadowed.visible = false;
    }

    set ruledLines(shown: boolean) {
        this.ruled.visible = shown;
    }
}
