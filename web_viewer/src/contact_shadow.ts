// A contact shadow: the model's height above the ground, seen from below, blurred twice and shown
// on the ground. It is drawn once per model, not once per frame.
import {
    DoubleSide,
    Group,
    HalfFloatType,
    Mesh,
    MeshBasicMaterial,
    OrthographicCamera,
    PlaneGeometry,
    ShaderMaterial,
    Vector2,
    WebGLRenderTarget,
    type Object3D,
    type Scene,
    type WebGLRenderer,
} from "three";

const size = 256;

const heightShader = {
    vertexShader: `
varying float height;
void main() {
    vec4 place = modelMatrix * vec4(position, 1.0);
    height = place.y;
    gl_Position = projectionMatrix * viewMatrix * place;
}`,
    fragmentShader: `
uniform float most;
varying float height;
void main() {
    float near = clamp(1.0 - height / most, 0.0, 1.0);
    gl_FragColor = vec4(0.0, 0.0, 0.0, near * near);
}`,
};

const blurShader = {
    vertexShader: `
varying vec2 at;
void main() {
    at = uv;
    gl_Position = vec4(position.xy, 0.0, 1.0);
}`,
    fragmentShader: `
uniform sampler2D image;
uniform vec2 offset;
varying vec2 at;
void main() {
    float sum = 0.0;
    float weights = 0.0;
    for (int i = -8; i <= 8; ++i) {
        float weight = exp(-float(i * i) / 28.0);
        sum += weight * texture2D(image, at + float(i) * offset).a;
        weights += weight;
    }
    gl_FragColor = vec4(0.0, 0.0, 0.0, sum / weights);
}`,
};

export class ContactShadow extends Group {
    private readonly target = new WebGLRenderTarget(size, size, { type: HalfFloatType });
    private readonly spare = new WebGLRenderTarget(size, size, { type: HalfFloatType });
    private readonly camera = new OrthographicCamera(-1, 1, 1, -1, 0, 1);
    private readonly height = new ShaderMaterial({
        ...heightShader,
        uniforms: { most: { value: 1 } },
        side: DoubleSide,
    });
    private readonly blur = new ShaderMaterial({
        ...blurShader,
        uniforms: { image: { value: null }, offset: { value: new Vector2() } },
        depthTest: false,
        depthWrite: false,
    });
    private readonly sheet = new PlaneGeometry(2, 2);
    private readonly screen = new Mesh(this.sheet, this.blur);
    private readonly screenCamera = new OrthographicCamera(-1, 1, 1, -1, 0, 1);
    private readonly plane: Mesh<PlaneGeometry, MeshBasicMaterial>;

    constructor() {
        super();
        const material = new MeshBasicMaterial({
            map: this.target.texture,
            transparent: true,
            depthWrite: false,
            opacity: 0.62,
            toneMapped: false,
        });
        // The camera looks up, so its picture is a mirror image of the ground seen from above.
        this.plane = new Mesh(new PlaneGeometry(2, 2).rotateX(-Math.PI / 2), material);
        this.plane.scale.z = -1;
        this.plane.renderOrder = -1;
        material.side = DoubleSide;
        this.camera.rotation.x = Math.PI / 2;
        this.screen.frustumCulled = false;
        this.add(this.plane);
    }

    set opacity(opacity: number) {
        this.plane.material.opacity = opacity;
    }

    /** Draws the shadow of `model`, a child of `scene`, on a square of half width `half`; `height`
     *  of the model, metres. */
    update(
        renderer: WebGLRenderer,
        scene: Scene,
        model: Object3D,
        half: number,
        height: number,
    ): void {
        this.plane.scale.set(half, 1, -half);
        Object.assign(this.camera, { left: -half, right: half, top: half, bottom: -half });
        this.camera.near = 0;
        this.camera.far = height;
        this.camera.position.y = -height * 0.02;
        this.camera.updateProjectionMatrix();
        this.height.uniforms["most"]!.value = height * 0.55;

        const hidden = scene.children.filter((child) => child !== model && child.visible);
        for (const child of hidden) child.visible = false;
        const { overrideMaterial, environment, background } = scene;
        const shadows = renderer.shadowMap.enabled;
        scene.overrideMaterial = this.height;
        scene.environment = null;
        scene.background = null;
        renderer.shadowMap.enabled = false;
        renderer.setRenderTarget(this.target);
        renderer.clear();
        renderer.render(scene, this.camera);
        scene.overrideMaterial = overrideMaterial;
        scene.environment = environment;
        scene.background = background;
        renderer.shadowMap.enabled = shadows;
        for (const child of hidden) child.visible = true;

        for (const width of [2.2, 1]) {
            this.pass(renderer, this.target, this.spare, width / size, 0);
            this.pass(renderer, this.spare, this.target, 0, width / size);
        }
        renderer.setRenderTarget(null);
    }

    private pass(
        renderer: WebGLRenderer,
        from: WebGLRenderTarget,
        to: WebGLRenderTarget,
        x: number,
        y: number,
    ): void {
        this.blur.uniforms["image"]!.value = from.texture;
        (this.blur.uniforms["offset"]!.value as Vector2).set(x, y);
        renderer.setRenderTarget(to);
        renderer.clear();
        renderer.render(this.screen, this.screenCamera);
    }
}
