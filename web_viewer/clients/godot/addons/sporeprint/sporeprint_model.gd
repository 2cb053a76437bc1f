class_name SporeprintModel
extends Node3D
## A mushroom, tree or leaf from a Sporeprint server that shows one level of detail at a time.
##
## The file has all levels from `lod` on as nodes with shared images; each becomes visible in the
## range of distances in which the next one would differ from it by a pixel.

## The server, or null for one at the default address.
@export var server: SporeprintServer
## Kind and name, as in the addresses of the server: "mushrooms/amanita_muscaria", "trees/birch".
@export var product := "mushrooms/amanita_muscaria"
## Further parameters of the query, by name: {"seed": 3, "age": 0.4}.
@export var parameters: Dictionary = {}
## The finest level of detail.
@export_range(0, 3) var lod := 1
## Whether to add a static body for physics.
@export var collision := false
## Whether wind moves it; see sporeprint_wind.gdshader.
@export var wind := false
## Vertical field of view of the camera for which levels are switched, degrees.
@export_range(10.0, 150.0) var field_of_view_deg := 75.0
## Share of a range by which neighbouring levels overlap, so that they do not flicker.
@export_range(0.0, 0.5) var hysteresis := 0.1

## Emitted after load_model(), with the levels, finest first; none after an error.
signal loaded(levels: Array[GeometryInstance3D])

const WIND := preload("sporeprint_wind.gdshader")

func _ready() -> void:
	load_model()

## Fetches the model and shows it instead of the one before; returns its levels, finest first.
func load_model() -> Array[GeometryInstance3D]:
	var found: Array[GeometryInstance3D] = []
	if server == null:
		server = SporeprintServer.new()
		add_child(server)
	var scene := await server.scene(path())
	if scene != null:
		for child in get_children():
			if child != server:
				child.queue_free()
		add_child(scene)
		found = _levels_of(scene)
		_switch(found, scene.get_meta("sporeprint"))
		if wind:
			_sway(found, scene.get_meta("sporeprint"))
	loaded.emit(found)
	return found

## Returns the path of the file below the server.
func path() -> String:
	var query := {"profile": "godot", "lods": "nodes", "lod": lod}
	if collision:
		query["collision"] = "omi"
	if wind:
		query["wind"] = "uv"
	query.merge(parameters, true)
	return "/v1/%s.glb?%s" % [product, HTTPClient.new().query_string_from_dict(query)]

func _levels_of(scene: Node) -> Array[GeometryInstance3D]:
	var found: Array[GeometryInstance3D] = []
	for node in scene.find_children("*_LOD?", "GeometryInstance3D", true, false):
		found.append(node)
	found.sort_custom(func(a, b): return a.name.naturalnocasecmp_to(b.name) < 0)
	return found

## Sets the distances between which each level is visible.
func _switch(levels: Array[GeometryInstance3D], extras: Dictionary) -> void:
	var box: Dictionary = extras.get("bounds_m", {})
	if levels.size() < 2 or box.is_empty() or not extras.has("levels"):
		return
	# A level is shown down to its share of the height of the screen.
	var height: float = box["max"][1] - box["min"][1]
	var near := 0.0
	for i in levels.size():
		var share: float = extras["levels"][i]["screen_coverage"]
		var far := height / (2.0 * share * tan(0.5 * deg_to_rad(field_of_view_deg)))
		levels[i].visibility_range_begin = near
		levels[i].visibility_range_begin_margin = hysteresis * near
		levels[i].visibility_range_end = far
		levels[i].visibility_range_end_margin = hysteresis * far
		near = far

## Replaces the materials by those that wind moves.
func _sway(levels: Array[GeometryInstance3D], extras: Dictionary) -> void:
	var of_file: Dictionary = extras.get("wind", {})
	for level in levels:
		var mesh: Mesh = level.mesh
		for surface in mesh.get_surface_count():
			var plain := mesh.surface_get_material(surface) as BaseMaterial3D
			if plain == null:
				continue
			var moved := ShaderMaterial.new()
			moved.shader = WIND
			moved.resource_name = plain.resource_name
			moved.set_shader_parameter("base_color", plain.albedo_texture)
			moved.set_shader_parameter("normal_map", plain.normal_texture)
			moved.set_shader_parameter("roughness_map", plain.roughness_texture)
			moved.set_shader_parameter("sway", of_file.get("sway_m", 0.0))
			mesh.surface_set_material(surface, moved)
