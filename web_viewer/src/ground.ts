// The ground of the stage: a sheet with ruled lines that fades out, or soil, and the shadow of the
// sun on it. All face upwards only, so that a view from below shows the mushroom alone.
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

// Soil is dark and blotched at all scales that a pixel can show, and fades into the background.
const soilShader = `
uniform vec3 colour;
uniform float reach;
varying vec2 at;
float hash(vec2 cell) {
    vec3 p = fract(vec3(cell.xyx) * 0.1031);
    p += dot(p, p.yzx + 33.33);
    return fract((p.x + p.y) * p.z);
}
float noise(vec2 place) {
    vec2 cell = floor(place);
    vec2 t = fract(place);
    t = t * t * (3.0 - 2.0 * t);
    return mix(mix(hash(cell), hash(cell + vec2(1.0, 0.0)), t.x),
               mix(hash(cell + vec2(0.0, 1.0)), hash(cell + vec2(1.0, 1.0)), t.x), t.y);
}
void main() {
    float blotches = 0.0;
    float size = reach * 0.08;
    float pixel = max(length(dFdx(at)), length(dFdy(at)));
    for (int octave = 0; octave < 7; ++octave) {
        float seen = 1.0 - smoothstep(0.25, 0.7, pixel / size);
        blotches += 0.2 * seen * (noise(at.yx / size + float(octave) * 17.3) - 0.5);
        size *= 0.5;
    }
    float near = 1.0 - smoothstep(reach * 0.15, reach, length(at));
    gl_FragColor = vec4(colour * exp(1.7 * blotches), near);
    #include <tonemapping_fragment>
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
    private readonly soilColour = new ShaderMaterial({
        uniforms: { colour: { value: new Color() }, reach: { value: 1 } },
        vertexShader,
        fragmentShader: soilShader,
        transparent: true,
        depthWrite: false,
    });
    private readonly soiled: Mesh;
    private readonly ruled: Mesh;
    private readonly shadowed: Mesh;

    constructor() {
        super();
        const disc = new CircleGeometry(1, 64).rotateX(-Math.PI / 2);
        this.ruled = new Mesh(disc, this.ruling);
        this.soiled = new Mesh(disc, this.soilColour);
        this.soiled.visible = false;
        this.soiled.renderOrder = -2;
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
        this.add(earth, this.ruled, this.soiled, shadow);
    }

    /** Fits the sheet to a model: `radius` in metres, lines every `spacing` metres. */
    fit(radius: number, spacing: number): void {
        this.scale.setScalar(radius * 9);
        this.ruling.uniforms["spacing"]!.value = spacing;
        this.ruling.uniforms["reach"]!.value = radius * 4;
        this.soilColour.uniforms["reach"]!.value = radius * 5;
    }

    colours(ink: ColorRepresentation, shadow: ColorRepresentation): void {
        (this.ruling.uniforms["ink"]!.value as Color).set(ink);
        this.shade.color.set(shadow);
    }

    /** Covers the ground with soil of a colour, linear; undefined for none. */
    set soil(colour: readonly [number, number, number] | undefined) {
        this.soiled.visible = colour !== undefined;
        if (colour) (this.soilColour.uniforms["colour"]!.value as Color).setRGB(...colour);
    }

    set shadowOpacity(opacity: number) {
        this.shade.opacity = opacity;
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
