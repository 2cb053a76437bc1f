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
## Begins with the level of detail nearest to this number of triangles instead; 0: with `lod`.
@export_range(0, 10000000) var triangles := 0
## Whether to add a static body for physics.
@export var collision := false
## Whether wind moves it; see sporeprint_wind.gdshader.
@export var wind := false
## Vertical field of view of the camera for which levels are switched, degrees.
@export_range(10.0, 150.0) var field_of_view_deg := 75.0

## Emitted after load_model(), with the levels, finest first; none after an error.
signal loaded(levels: Array[GeometryInstance3D])

const WIND := preload("sporeprint_wind.gdshader")
const IMPOSTOR := preload("sporeprint_impostor.gdshader")

var _shown: Node3D
var _turn := 0

func _ready() -> void:
	# Later, so that who adds the node can wait for `loaded`.
	load_model.call_deferred()

## Fetches the model and shows it instead of the one before; returns its levels, finest first. If it
## is called again before it ends, only the last call shows something.
func load_model() -> Array[GeometryInstance3D]:
	_turn += 1
	var turn := _turn
	var requested := path()
	var moves := wind
	if server == null:
		server = SporeprintServer.new()
		add_child(server)
	var body := await server.fetch(requested)
	var found: Array[GeometryInstance3D] = []
	if turn != _turn:
		return found
	var scene := server.parse(body, requested)
	if scene != null:
		if is_instance_valid(_shown):
			_shown.queue_free()
		_shown = scene
		add_child(scene)
		found = _levels_of(scene)
		if scene.has_meta("sporeprint_impostor"):
			# Red is depth; the file says so by an occlusion of strength 0, which Godot does not read.
			var cards := found[-1].mesh.surface_get_material(0) as BaseMaterial3D
			cards.ao_enabled = false
		_switch(found, scene.get_meta("sporeprint"))
		if moves:
			_sway(found, scene.get_meta("sporeprint"))
	loaded.emit(found)
	return found

## Returns the path of the file below the server.
func path() -> String:
	# Both are named, since the profile sets them for some products.
	var query := {"profile": "godot", "lods": "nodes",
			"collision": "omi" if collision else "none", "wind": "uv" if wind else "none"}
	if triangles > 0:
		query["triangles"] = triangles
	else:
		query["lod"] = lod
	query.merge(parameters, true)
	return "/v1/%s.glb?%s" % [product, HTTPClient.new().query_string_from_dict(query)]

## Returns a mesh that faces the camera and shows the impostor of the model, for a MeshInstance3D at its
## place or a MultiMesh of many; null if the file has none. Parameters: {"impostor": "true"}.
func as_impostor() -> Mesh:
	if not is_instance_valid(_shown) or not _shown.has_meta("sporeprint_impostor"):
		return null
	var stated: Dictionary = _shown.get_meta("sporeprint_impostor")
	var cards: Mesh = _levels_of(_shown)[-1].mesh
	var plain := cards.surface_get_material(0) as BaseMaterial3D
	var centre := Vector3(stated["centre_m"][0], stated["centre_m"][1], stated["centre_m"][2])
	var radius: float = stated["radius_m"]
	var material := ShaderMaterial.new()
	material.shader = IMPOSTOR
	material.resource_name = plain.resource_name
	material.set_shader_parameter("base_color", plain.albedo_texture)
	material.set_shader_parameter("normal_map", plain.normal_texture)
	material.set_shader_parameter("surface_map", plain.roughness_texture)
	for name in ["grid", "frame_texels", "side_texels", "normal_length", "cutoff"]:
		material.set_shader_parameter(name, stated[name])
	material.set_shader_parameter("centre", centre)
	material.set_shader_parameter("radius", radius)
	if plain.emission_enabled:
		material.set_shader_parameter("glow", plain.emission * plain.emission_energy_multiplier)
	var quad := QuadMesh.new()
	quad.size = Vector2(2.0, 2.0)
	quad.material = material
	quad.custom_aabb = AABB(centre - Vector3.ONE * radius, 2.0 * Vector3.ONE * radius)
	return quad

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
	# Distances are measured to the middle of a box: all levels have the same one.
	var whole: AABB = levels[0].get_aabb()
	var size := 0.0
	for level in levels:
		whole = whole.merge(level.get_aabb())
	for axis in 3:
		size = maxf(size, box["max"][axis] - box["min"][axis])
	var scale_here := global_basis.get_scale()
	size *= maxf(scale_here.x, maxf(scale_here.y, scale_here.z))
	# A level is shown down to its share of the height of the screen.
	var near := 0.0
	for i in levels.size():
		var share: float = extras["levels"][i]["screen_coverage"]
		var far := size / (2.0 * share * tan(0.5 * deg_to_rad(field_of_view_deg)))
		levels[i].custom_aabb = whole
		levels[i].visibility_range_begin = near
		levels[i].visibility_range_end = far
		near = far

## Replaces the materials by those that wind moves.
func _sway(levels: Array[GeometryInstance3D], extras: Dictionary) -> void:
	var of_file: Dictionary = extras.get("wind", {})
	for level in levels:
		# The shader leans by at most 3.6 times the displacement of a breeze.
		level.extra_cull_margin = 3.6 * of_file.get("sway_m", 0.0)
		var mesh: Mesh = level.mesh
		for surface in mesh.get_surface_count():
			var plain := mesh.surface_get_material(surface) as BaseMaterial3D
			# The cards of an impostor stand still: the shader of wind has no alpha.
			if plain == null or plain.transparency != BaseMaterial3D.TRANSPARENCY_DISABLED:
				continue
			var moved := ShaderMaterial.new()
			moved.shader = WIND
			moved.resource_name = plain.resource_name
			moved.set_shader_parameter("base_color", plain.albedo_texture)
			moved.set_shader_parameter("normal_map", plain.normal_texture)
			moved.set_shader_parameter("roughness_map", plain.roughness_texture)
			moved.set_shader_parameter("sway", of_file.get("sway_m", 0.0))
			if plain.emission_enabled:
				moved.set_shader_parameter(
						"glow", plain.emission * plain.emission_energy_multiplier)
			mesh.surface_set_material(surface, moved)
