extends Node3D
## Uses the add-on against a server at the page's own address, and prints what it got as lines of
## JSON that begin with RESULT.

var statuses: Array[int] = []
var server := SporeprintServer.new()

func report(what: String, found: Dictionary) -> void:
	found["statuses"] = statuses.duplicate()
	statuses.clear()
	print("RESULT ", JSON.stringify({what: found}))

func triangles(mesh: Mesh) -> int:
	var sum := 0
	for surface in mesh.get_surface_count():
		@warning_ignore("integer_division")
		sum += mesh.surface_get_arrays(surface)[Mesh.ARRAY_INDEX].size() / 3
	return sum

func shown_model(model: SporeprintModel) -> Dictionary:
	model.server = server
	add_child(model)
	var levels: Array = await model.loaded
	var found := {"levels": [], "bodies": model.find_children("*", "StaticBody3D", true, false).size(),
			"solids": model.find_children("*", "CollisionShape3D", true, false).size()}
	for level in levels:
		var box: AABB = level.global_transform * level.get_aabb()
		var material = level.mesh.surface_get_material(0)
		found.levels.append({"name": level.name, "triangles": triangles(level.mesh),
				"min": [box.position.x, box.position.y, box.position.z],
				"max": [box.end.x, box.end.y, box.end.z],
				"begin": level.visibility_range_begin, "end": level.visibility_range_end,
				"sway": material.get_shader_parameter("sway") if material is ShaderMaterial else 0.0,
				"material": material.get_class(),
				"side": material.albedo_texture.get_width() if material is BaseMaterial3D
						else material.get_shader_parameter("base_color").get_width()})
	return found

## Opens a file as a game would that has no add-on, and returns what is in it.
func shown_file(path: String) -> Dictionary:
	var node: Node3D = server.parse(await server.fetch(path), path)
	add_child(node)
	var found := {"meshes": 0, "triangles": 0, "pictures": true}
	var box := AABB()
	for part in node.find_children("*", "MeshInstance3D", true, false):
		var own: AABB = part.global_transform * part.get_aabb()
		box = own if found.meshes == 0 else box.merge(own)
		found.meshes += 1
		found.triangles += triangles(part.mesh)
		for surface in part.mesh.get_surface_count():
			var material: BaseMaterial3D = part.mesh.surface_get_material(surface)
			# Soil has colours of vertices alone.
			if material.resource_name == "soil":
				continue
			if material.albedo_texture == null or material.albedo_texture.get_width() < 1:
				found.pictures = false
	found["min"] = [box.position.x, box.position.y, box.position.z]
	found["max"] = [box.end.x, box.end.y, box.end.z]
	node.queue_free()
	return found

## Returns the size and the mean colour of what a mesh covers, seen from between two frames.
func picture_of(mesh: Mesh, middle: Vector3) -> Dictionary:
	var view := SubViewport.new()
	view.size = Vector2i(96, 96)
	view.own_world_3d = true
	view.transparent_bg = true
	view.render_target_update_mode = SubViewport.UPDATE_ALWAYS
	add_child(view)
	var drawn := MeshInstance3D.new()
	drawn.mesh = mesh
	view.add_child(drawn)
	var sun := DirectionalLight3D.new()
	view.add_child(sun)
	sun.look_at_from_position(Vector3(1, 2, 1), Vector3.ZERO)
	var eye := Camera3D.new()
	view.add_child(eye)
	eye.fov = 20.0
	eye.look_at_from_position(middle + Vector3(0.2, 0.25, 0.5), middle)
	for i in 3:
		await RenderingServer.frame_post_draw
	var picture := view.get_texture().get_image()
	var covered := 0
	var sum := Vector3.ZERO
	for x in 96:
		for y in 96:
			var pixel := picture.get_pixel(x, y)
			if pixel.a > 0.5:
				covered += 1
				sum += Vector3(pixel.r, pixel.g, pixel.b)
	view.queue_free()
	var mean := sum / maxi(covered, 1)
	return {"covered": covered, "mean": [mean.x, mean.y, mean.z]}

func _ready() -> void:
	server.address = JavaScriptBridge.eval("location.origin")
	server.fetched.connect(func(_path, status): statuses.append(status))
	add_child(server)

	var mushroom := SporeprintModel.new()
	mushroom.parameters = {"texture_size": 256, "seed": 3}
	mushroom.collision = true
	report("mushroom", await shown_model(mushroom))
	var again := SporeprintModel.new()
	again.parameters = mushroom.parameters
	again.collision = true
	again.position = Vector3(0.3, 0.0, 0.0)
	report("again", await shown_model(again))

	var tree := SporeprintModel.new()
	tree.product = "trees/shrub"
	tree.parameters = {"texture_size": 128}
	tree.wind = true
	tree.position = Vector3(-0.5, 0.0, -1.5)
	report("tree", await shown_model(tree))

	var colony := SporeprintColony.new()
	colony.server = server
	colony.parameters = {"texture_size": 128, "count": 12, "distinct": 3, "seed": 2}
	colony.position = Vector3(-0.2, 0.0, 0.0)
	add_child(colony)
	var parts: Array = await colony.loaded
	report("colony", {"parts": parts.map(func(part): return {"name": part.name,
			"count": part.multimesh.instance_count, "triangles": triangles(part.multimesh.mesh)})})

	var world := "/v1/worlds/beech,seed=7,extent=256/"
	report("plot", await shown_file(world + "y80d270/plot.glb?x=20&y=-5&size=4&lod=2&texture_size=256&layers=ground+trees+fungi"))
	for tile in ["ground", "trees", "fungi"]:
		var time := "y80d270" if tile == "fungi" else "y80m10"
		report(tile, await shown_file(world + "core/" + time + "/" + tile + "/5/14/21.glb"))

	var distant := SporeprintModel.new()
	distant.parameters = {"texture_size": 1024, "seed": 3, "lod": 2, "impostor": "true"}
	var impostor := await shown_model(distant)
	impostor["pictures"] = []
	var mesh: Mesh = distant.find_child("*_LOD0", true, false).mesh
	for shown in [mesh, distant.as_impostor()]:
		impostor.pictures.append(await picture_of(shown, mesh.get_aabb().get_center()))
	distant.queue_free()
	report("impostor", impostor)

	var described := await server.description(
			"/v1/mushrooms/boletus_edulis.json?lod=3&texture_size=128")
	var versioned: String = described["canonical"] + "&v=" + described["v"]
	for i in 2:
		await server.fetch(versioned)
	report("versioned", {})
	report("refused", {"bytes": (await server.fetch("/v1/mushrooms/amanita_muscarla.glb")).size()})
	JavaScriptBridge.eval("fetch('/down')")
	await get_tree().create_timer(0.5).timeout
	report("offline", {"bytes": (await server.fetch(mushroom.path())).size()})

	# Where no level was seen before, beside each distance at which levels change.
	var seen := []
	for level in mushroom.find_children("*_LOD?", "MeshInstance3D", true, false):
		for nearly in [0.97, 1.03]:
			var view := SubViewport.new()
			view.size = Vector2i(64, 64)
			view.own_world_3d = true
			view.render_target_update_mode = SubViewport.UPDATE_ALWAYS
			add_child(view)
			var copy: Node3D = level.get_parent().duplicate()
			view.add_child(copy)
			var middle: Vector3 = level.custom_aabb.get_center()
			var eye := Camera3D.new()
			view.add_child(eye)
			# The model is two thirds of the view, or less where it is far.
			var distance: float = nearly * level.visibility_range_end
			var side: float = level.custom_aabb.get_longest_axis_size()
			eye.fov = maxf(2.0, rad_to_deg(2.0 * atan(0.75 * side / distance)))
			eye.far = 1e4
			eye.look_at_from_position(middle + Vector3(0.0, 0.0, distance), middle)
			for i in 3:
				await RenderingServer.frame_post_draw
			var picture := view.get_texture().get_image()
			var ground := picture.get_pixel(0, 0)
			var different := 0
			for x in 64:
				for y in 64:
					different += 1 if picture.get_pixel(x, y) != ground else 0
			seen.append(different)
			view.queue_free()
	report("seen", {"pixels": seen})

	var camera := Camera3D.new()
	add_child(camera)
	camera.look_at_from_position(Vector3(0.05, 0.25, 0.75), Vector3(0.05, 0.1, 0.0))
	var sun := DirectionalLight3D.new()
	add_child(sun)
	sun.look_at_from_position(Vector3(1, 2, 1), Vector3.ZERO)
	for i in 10:
		await get_tree().process_frame
	print("RESULT ", JSON.stringify({"end": true}))
