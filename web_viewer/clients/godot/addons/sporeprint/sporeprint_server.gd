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

## Returns the body of a path such as "/v1/mushrooms/amanita_muscaria.glb?lod=1", fetched or stored;
## empty after an error, which is reported with the words of the server.
func fetch(path: String) -> PackedByteArray:
	var file := folder.path_join((address + path).sha256_text()) if folder else ""
	var stored := file != "" and FileAccess.file_exists(file + ".etag")
	if stored and _is_versioned(path):
		fetched.emit(path, 0)
		return FileAccess.get_file_as_bytes(file)
	var headers := PackedStringArray()
	if stored:
		headers.append("If-None-Match: " + FileAccess.get_file_as_string(file + ".etag"))
	var request := HTTPRequest.new()
	request.timeout = timeout_s
	add_child(request)
	var error := request.request(address + path, headers)
	if error != OK:
		request.queue_free()
		push_error("Sporeprint: %s%s: %s" % [address, path, error_string(error)])
		return PackedByteArray()
	var answer: Array = await request.request_completed
	request.queue_free()
	var result: int = answer[0]
	var status: int = answer[1]
	var body: PackedByteArray = answer[3]
	if result == HTTPRequest.RESULT_SUCCESS and status == 200:
		if file != "":
			_store(file, body, _header(answer[2], "etag"))
		fetched.emit(path, status)
		return body
	if stored and (result != HTTPRequest.RESULT_SUCCESS or status == 304):
		fetched.emit(path, status if result == HTTPRequest.RESULT_SUCCESS else 0)
		return FileAccess.get_file_as_bytes(file)
	push_error("Sporeprint: %s%s: %s" % [address, path, _reason(result, status, body)])
	return PackedByteArray()

## Returns a scene made of a GLB file of the server, and the extras of the file in its metadata
## "sporeprint"; null after an error.
func scene(path: String) -> Node3D:
	var body := await fetch(path)
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

static func _header(headers: PackedStringArray, wanted: String) -> String:
	for line in headers:
		if line.get_slice(":", 0).strip_edges().to_lower() == wanted:
			return line.substr(line.find(":") + 1).strip_edges()
	return ""

static func _reason(result: int, status: int, body: PackedByteArray) -> String:
	if result != HTTPRequest.RESULT_SUCCESS:
		return "no connection (HTTPRequest result %d)" % result
	var problem = JSON.parse_string(body.get_string_from_utf8())
	if not problem is Dictionary:
		return "status %d" % status
	var words: PackedStringArray = [str(problem.get("detail", "status %d" % status))]
	for error in problem.get("errors", []):
		words.append("%s: %s" % [error.get("parameter", error.get("pointer", "")), error["detail"]])
	return "; ".join(words)
