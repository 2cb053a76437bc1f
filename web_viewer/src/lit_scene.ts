// A renderer and a scene with one of the lights, the same for the stage and for sheets.
import {
    DirectionalLight,
    HemisphereLight,
    Mesh,
    NeutralToneMapping,
    PCFShadowMap,
    PMREMGenerator,
    Scene,
    Vector3,
    WebGLRenderer,
    type Material,
    type Sphere,
    type WebGLRenderTarget,
} from "three";
import { homeAzimuth, lights, surroundingsOf, type Light, type LightName } from "./lights";

/** Blur of the environment, radians: softens the edges of its flat surfaces. */
const environmentBlur = 0.04;

/** The light of a scene: environment, sun and light from the ground. */
export class SceneLight {
    readonly sun = new DirectionalLight();
    private readonly bounce = new HemisphereLight(0x000000);
    private readonly sunDirection = new Vector3();
    private environment: WebGLRenderTarget | undefined;
    private used: LightName | undefined;

    /** `azimuth` of the camera of the first view, degrees from +Z to +X. */
    constructor(
        private readonly renderer: WebGLRenderer,
        private readonly scene: Scene,
        private readonly azimuth: number,
    ) {
        this.sun.castShadow = true;
        this.sun.shadow.mapSize.set(1024, 1024);
        scene.add(this.sun, this.sun.target, this.bounce);
        this.use("daylight");
    }

    get current(): Light {
        return lights[this.used ?? "daylight"];
    }

    /** Lights the scene anew; returns false if it has this light already. */
    use(name: LightName): boolean {
        if (this.used === name) return false;
        this.used = name;
        const { sun, bounce, background, environmentIntensity, exposure } = lights[name];
        this.renderer.toneMappingExposure = exposure;
        this.makeEnvironment(name);
        this.scene.environmentIntensity = environmentIntensity;
        this.scene.background =
            background === "sheet" ? null : (this.environment?.texture ?? null);
        if (background !== "sheet") {
            this.scene.backgroundBlurriness = background.blurriness;
            this.scene.backgroundIntensity = background.intensity;
        }
        this.sun.color.set(sun.colour);
        this.sun.intensity = sun.intensity;
        this.sun.shadow.radius = sun.blur;
        // The daylight of the plates is the same from wherever the first view is.
        const azimuth = sun.azimuth + (name === "daylight" ? homeAzimuth : this.azimuth);
        this.sunDirection.setFromSphericalCoords(
            1,
            ((90 - sun.elevation) * Math.PI) / 180,
            (azimuth * Math.PI) / 180,
        );
        // Light reflected by the ground makes gills and pores visible from below.
        this.bounce.groundColor.set(bounce.colour);
        this.bounce.intensity = bounce.intensity;
        return true;
    }

    /** Fits the shadow camera of the sun to a model of this size. */
    aim(ball: Sphere): void {
        const { sun } = this;
        const reach = ball.radius * 1.7;
        sun.target.position.copy(ball.center);
        sun.position
            .copy(this.sunDirection)
            .multiplyScalar(ball.radius * 4)
            .add(ball.center);
        const camera = sun.shadow.camera;
        Object.assign(camera, { left: -reach, right: reach, top: reach, bottom: -reach });
        camera.near = ball.radius;
        camera.far = ball.radius * 8;
        camera.updateProjectionMatrix();
        sun.shadow.normalBias = ball.radius * 0.006;
        sun.shadow.bias = -0.0006;
        sun.target.updateMatrixWorld();
    }

    dispose(): void {
        this.environment?.dispose();
        this.sun.dispose();
    }

    private makeEnvironment(name: LightName): void {
        const surroundings = surroundingsOf(name, this.azimuth);
        const generator = new PMREMGenerator(this.renderer);
        this.environment?.dispose();
        this.environment = generator.fromScene(surroundings, environmentBlur);
        this.scene.environment = this.environment.texture;
        generator.dispose();
        surroundings.traverse((node) => {
            if (!(node instanceof Mesh)) return;
            const { geometry, material } = node as Mesh<Mesh["geometry"], Material>;
            geometry.dispose();
            material.dispose();
        });
    }
}

/** Returns a renderer and a scene in daylight. `azimuth` of the camera of the first view, degrees
 *  from +Z to +X. */
export function litScene(
    canvas: HTMLCanvasElement,
    antialias: boolean,
    azimuth = homeAzimuth,
): {
    renderer: WebGLRenderer;
    scene: Scene;
    light: SceneLight;
} {
    const renderer = new WebGLRenderer({ canvas, antialias, alpha: true });
    renderer.toneMapping = NeutralToneMapping;
    renderer.shadowMap.enabled = true;
    renderer.shadowMap.type = PCFShadowMap;
    const scene = new Scene();
    return { renderer, scene, light: new SceneLight(renderer, scene, azimuth) };
}
