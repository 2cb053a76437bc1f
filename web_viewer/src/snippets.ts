// Code that loads the shown model in the engine of its profile. That for three.js is what the page
// itself does; the others follow the documentation of their loaders and were not tried here.

/** Returns a few lines that load a file, for the engine of a profile; three.js if it has none. */
export function snippetFor(profile: string, url: string): string {
    switch (profile) {
        case "godot":
            return `# Godot 4; not tried by the authors of this page
var request := HTTPRequest.new()
add_child(request)
request.request("${url}")
var bytes: PackedByteArray = (await request.request_completed)[3]
var document := GLTFDocument.new()
var state := GLTFState.new()
document.append_from_buffer(bytes, "", state)
add_child(document.generate_scene(state))
`;
        case "unity":
            return `// glTFast 6; not tried by the authors of this page
var gltf = new GLTFast.GltfImport();
if (await gltf.Load("${url}"))
    await gltf.InstantiateMainSceneAsync(transform);
`;
        case "unreal":
            return `// glTFRuntime; not tried by the authors of this page
FglTFRuntimeConfig Config;
FglTFRuntimeHttpResponse Loaded;
Loaded.BindDynamic(this, &AMyActor::OnLoaded);
UglTFRuntimeFunctionLibrary::glTFLoadAssetFromUrl(TEXT("${url}"), {}, Loaded, Config);
`;
        case "blender":
            return `# Blender 3.4; not tried by the authors of this page
import bpy, tempfile, urllib.request
with tempfile.NamedTemporaryFile(suffix=".glb") as file:
    file.write(urllib.request.urlopen("${url}").read())
    file.flush()
    bpy.ops.import_scene.gltf(filepath=file.name)
`;
        case "cesium":
            return `// CesiumJS; not tried by the authors of this page
const model = await Cesium.Model.fromGltfAsync({ url: "${url}" });
viewer.scene.primitives.add(model);
`;
        default:
            return `import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { MeshoptDecoder } from "three/addons/libs/meshopt_decoder.module.js";
const loader = new GLTFLoader().setMeshoptDecoder(MeshoptDecoder);
const { scene: model } = await loader.loadAsync("${url}");
scene.add(model);
`;
    }
}
