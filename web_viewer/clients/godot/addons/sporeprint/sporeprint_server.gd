class_name SporeprintServer
extends Node
## Fetches files of a Sporeprint server and stores them on disk.
##
## A stored file is asked for again with its ETag, so that the server answers 304 without a body
## unless the file has changed; addresses with a version (`v=`) never change and are not asked for
## again. Without a connection the stored file is used.

## The address of the server, without a slash at its end.
@export var address := "http://127.0.0.1:8080"
## Where files are stored; empty to store none.
@export_dir var folder := "user://sporeprint"
## Seconds after which a request fails.
@export_range(1.0, 600.0) var timeout_s := 60.0

## Emitted once for each file that is asked for: its path below the server, and the status of the
## answer (200, 304), or 0 if the stored file was used without one.
signal fetched(path: String, status: int)

## How often a request is repeated while the server is busy (429, 503).
const MOST_RETRIES := 5

## Returns the body of a path such as "/v1/mushrooms/amanita_muscaria.glb?lod=1", fetched or stored;
## empty after an error, which is reported with the words of the server.
func fetch(path: String) -> PackedByteArray:
	var file := folder.path_join((address + path).sha256_text()) if folder else ""
	var stored := file != "" and FileAccess.file_exists(file) \
			and FileAccess.file_exists(file + ".etag")
	if stored and _is_versioned(path):
		fetched.emit(path, 0)
		return FileAccess.get_file_as_bytes(file)
	var headers := PackedStringArray()
	if stored:
		headers.append("If-None-Match: " + FileAccess.get_file_as_string(file + ".etag"))
	var answer := await _answer(path, headers)
	var status: int = answer.status
	if status == 200:
		if file != "":
			_store(file, answer.body, _header(answer.headers, "etag"))
		fetched.emit(path, status)
		return answer.body
	# Without a connection, and while the server is busy or fails, what is stored is better than
	# nothing.
	if stored and (status == 0 or status == 304 or status == 429 or status >= 500):
		fetched.emit(path, 304 if status == 304 else 0)
		return FileAccess.get_file_as_bytes(file)
	push_error("Sporeprint: %s%s: %s" % [address, path, _reason(answer)])
	return PackedByteArray()

## Returns status, headers, body and words of the answer to a request; status 0 for none.
func _answer(path: String, headers: PackedStringArray) -> Dictionary:
	for retry in MOST_RETRIES + 1:
		var request := HTTPRequest.new()
		request.timeout = timeout_s
		# A browser decompresses, but leaves the header by which Godot would do it again.
		request.accept_gzip = not OS.has_feature("web")
		add_child(request)
		var error := request.request(address + path, headers)
		if error != OK:
			request.queue_free()
			return {"status": 0, "words": error_string(error)}
		var answer: Array = await request.request_completed
		request.queue_free()
		if answer[0] != HTTPRequest.RESULT_SUCCESS:
			return {"status": 0, "words": "no connection (HTTPRequest result %d)" % answer[0]}
		if retry == MOST_RETRIES or not answer[1] in [429, 503]:
			return {"status": answer[1], "headers": answer[2], "body": answer[3]}
		var wait := _header(answer[2], "retry-after").to_float()
		await get_tree().create_timer(clampf(wait, 0.2, 30.0)).timeout
	return {"status": 0, "words": "no answer"}

## Returns a scene made of a GLB file of the server, with the extras of the file in its metadata
## "sporeprint"; null after an error.
func scene(path: String) -> Node3D:
	return parse(await fetch(path), path)

## Returns a scene made of the body of a GLB file, as scene() does; null for an empty body.
##
## path  of the file, for messages
func parse(body: PackedByteArray, path: String) -> Node3D:
	if body.is_empty():
		return null
	var document := GLTFDocument.new()
	var state := GLTFState.new()
	var error := document.append_from_buffer(body, "", state)
	if error != OK:
		push_error("Sporeprint: %s%s: %s" % [address, path, error_string(error)])
		return null
	var node: Node3D = document.generate_scene(state)
	node.set_meta("sporeprint", state.json["asset"].get("extras", {}))
	for material in state.json.get("materials", []):
		if material.get("extras", {}).has("impostor"):
			var impostor: Dictionary = material["extras"]["impostor"]
			impostor["cutoff"] = material["alphaCutoff"]
			node.set_meta("sporeprint_impostor", impostor)
	return node

## Returns a JSON document of the server; an empty dictionary after an error.
func description(path: String) -> Dictionary:
	var body := await fetch(path)
	var json = JSON.parse_string(body.get_string_from_utf8()) if not body.is_empty() else null
	return json if json is Dictionary else {}

static func _is_versioned(path: String) -> bool:
	for parameter in path.get_slice("?", 1).split("&"):
		if parameter.begins_with("v="):
			return true
	return false

func _store(file: String, body: PackedByteArray, etag: String) -> void:
	if etag == "":
		return
	DirAccess.make_dir_recursive_absolute(folder)
	# The ETag is written last: a file without one is not used.
	DirAccess.remove_absolute(file + ".etag")
	for part in [[file, body], [file + ".etag", etag.to_utf8_buffer()]]:
		var out := FileAccess.open(part[0], FileAccess.WRITE)
		if out == null:
			push_warning("Sporeprint: %s: %s" % [part[0], error_string(FileAccess.get_open_error())])
			return
		out.store_buffer(part[1])
		out.close()
		# A full disk takes a part of a file.
		if FileAccess.get_file_as_bytes(part[0]) != part[1]:
			DirAccess.remove_absolute(part[0])
			push_warning("Sporeprint: %s could not be stored as a whole" % part[0])
			return

static func _header(headers: PackedStringArray, wanted: String) -> String:
	for line in headers:
		if line.get_slice(":", 0).strip_edges().to_lower() == wanted:
			return line.substr(line.find(":") + 1).strip_edges()
	return ""

static func _reason(answer: Dictionary) -> String:
	if answer.status == 0:
		return answer.words
	var problem = JSON.parse_string(answer.body.get_string_from_utf8())
	if not problem is Dictionary:
		return "status %d" % answer.status
	var words: PackedStringArray = [str(problem.get("detail", "status %d" % answer.status))]
	for error in problem.get("errors", []):
		words.append("%s: %s" % [error.get("parameter", error.get("pointer", "")), error["detail"]])
	return "; ".join(words)
