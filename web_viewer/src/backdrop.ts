// The sheet behind the model: the gradient of the stage's style, drawn as a part of the picture, so
// that saved pictures have it too.
import {
    Color,
    Mesh,
    PlaneGeometry,
    ShaderMaterial,
    SRGBColorSpace,
    Vector3,
    Vector4,
    type ColorRepresentation,
} from "three";

// The same ellipse as that of #stage in app.css.
const fragmentShader = `
uniform vec3 nearColour;
uniform vec3 midColour;
uniform vec3 farColour;
uniform vec4 tile;
varying vec2 at;
void main() {
    vec2 place = tile.xy + vec2(at.x, 1.0 - at.y) * tile.zw;
    float far = length((place - vec2(0.5, 0.42)) / vec2(0.75, 0.65));
    vec3 colour = mix(nearColour, midColour, clamp(far / 0.6, 0.0, 1.0));
    colour = mix(colour, farColour, clamp((far - 0.6) / 0.7, 0.0, 1.0));
    gl_FragColor = vec4(colour, 1.0);
}`;

const vertexShader = `
varying vec2 at;
void main() {
    at = uv;
    gl_Position = vec4(position.xy, 1.0, 1.0);
}`;

export class Backdrop extends Mesh<PlaneGeometry, ShaderMaterial> {
    constructor() {
        super(
            new PlaneGeometry(2, 2),
            new ShaderMaterial({
                uniforms: {
                    nearColour: { value: new Vector3(1, 1, 1) },
                    midColour: { value: new Vector3(1, 1, 1) },
                    farColour: { value: new Vector3(1, 1, 1) },
                    tile: { value: new Vector4(0, 0, 1, 1) },
                },
                vertexShader,
                fragmentShader,
                depthTest: false,
                depthWrite: false,
            }),
        );
        this.frustumCulled = false;
        this.renderOrder = -4;
    }

    colours(near: ColorRepresentation, mid: ColorRepresentation, far: ColorRepresentation): void {
        for (const [name, colour] of Object.entries({ near, mid, far })) {
            // Values as in the style, since the gradient is one between them.
            const { r, g, b } = new Color(colour).getRGB({ r: 0, g: 0, b: 0 }, SRGBColorSpace);
            (this.material.uniforms[`${name}Colour`]!.value as Vector3).set(r, g, b);
        }
    }

    /** The part of the whole picture that is drawn: left, top, width and height as fractions. */
    set tile([x, y, width, height]: readonly [number, number, number, number]) {
        (this.material.uniforms["tile"]!.value as Vector4).set(x, y, width, height);
    }
}
