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

var _parts: Array[GeometryInstance3D] = []
var _turn := 0

func _ready() -> void:
	# Later, so that who adds the node can wait for `loaded`.
	load_colony.call_deferred()

## Fetches the colony and shows it instead of the one before. If it is called again before it ends,
## only the last call shows something.
func load_colony() -> Array[GeometryInstance3D]:
	_turn += 1
	var turn := _turn
	if server == null:
		server = SporeprintServer.new()
		add_child(server)
	var requested := path()
	var body := await server.fetch(requested)
	var parts: Array[GeometryInstance3D] = []
	if turn != _turn:
		return parts
	var scene := server.parse(body, requested)
	if scene != null:
		for part in _parts:
			part.queue_free()
		parts = _batched(scene)
		scene.free()
		for part in parts:
			add_child(part)
		_parts = parts
	loaded.emit(parts)
	return parts

## Returns the path of the file below the server.
func path() -> String:
	# A MultiMesh has no bodies.
	var query := {"profile": "godot", "lod": lod, "collision": "none"}
	query.merge(parameters, true)
	return "/v1/colonies/%s.glb?%s" % [species, HTTPClient.new().query_string_from_dict(query)]

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
