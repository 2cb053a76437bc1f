class_name SporeprintColony
extends Node3D
## A colony from a Sporeprint server that draws the individuals of each mesh in one call.

## The server, or null for one at the default address.
@export var server: SporeprintServer
## Species or mix of the colony.
@export var species := "hypholoma_fasciculare"
## Further parameters of the query, by name: {"seed": 3, "count": 40}.
@export var parameters: Dictionary = {}
## Level of detail.
@export_range(0, 3) var lod := 1

## Emitted after load_colony(), with one node for each draw call; none after an error.
signal loaded(parts: Array[GeometryInstance3D])

func _ready() -> void:
	load_colony()

## Fetches the colony and shows it instead of the one before.
func load_colony() -> Array[GeometryInstance3D]:
	var parts: Array[GeometryInstance3D] = []
	if server == null:
		server = SporeprintServer.new()
		add_child(server)
	var query := {"profile": "godot", "lod": lod}
	query.merge(parameters, true)
	var scene := await server.scene(
			"/v1/colonies/%s.glb?%s" % [species, HTTPClient.new().query_string_from_dict(query)])
	if scene != null:
		for child in get_children():
			if child != server:
				child.queue_free()
		parts = _batched(scene)
		scene.free()
		for part in parts:
			add_child(part)
	loaded.emit(parts)
	return parts

## Returns a MultiMesh for each mesh of a scene, with its places.
static func _batched(scene: Node3D) -> Array[GeometryInstance3D]:
	var places := {}
	for node: MeshInstance3D in scene.find_children("*", "MeshInstance3D", true, false):
		var place := node.transform
		var parent := node.get_parent_node_3d()
		while parent != null:
			place = parent.transform * place
			parent = parent.get_parent_node_3d()
		if not places.has(node.mesh):
			places[node.mesh] = []
		places[node.mesh].append(place)
	var parts: Array[GeometryInstance3D] = []
	for mesh: Mesh in places:
		var batch := MultiMesh.new()
		batch.transform_format = MultiMesh.TRANSFORM_3D
		batch.mesh = mesh
		batch.instance_count = places[mesh].size()
		for i in batch.instance_count:
			batch.set_instance_transform(i, places[mesh][i])
		var part := MultiMeshInstance3D.new()
		part.name = mesh.resource_name
		part.multimesh = batch
		parts.append(part)
	return parts
