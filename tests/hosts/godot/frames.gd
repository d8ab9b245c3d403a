# SPDX-License-Identifier: Apache-2.0
# What godot_test.py asks of the class, with Godot's own answers beside it. Prints a line each.
extends SceneTree

const Stylet = preload("res://stylet.gdns")


func _init():
	before_and_wrong()
	var stylet = Stylet.new()
	var file = File.new()
	file.open("res://liver.organ", File.READ)
	print("opened ", stylet.open(file.get_buffer(file.get_len()), {"bending_nm2": 0.02, "rods": 8},
			0.001) == "")
	var mesh = ArrayMesh.new()
	mesh.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, stylet.mesh(), [], 0)
	# The bytes that Godot makes of vertices and normals are those that surface() writes.
	print("layout ", VisualServer.mesh_surface_get_array(mesh.get_rid(), 0) == stylet.surface())
	var box = mesh.get_aabb()
	print("box ", box.position.distance_to(stylet.box().position) < 1e-6,
			" ", box.end.distance_to(stylet.box().end) < 1e-6)
	outward(mesh)
	var above = box.position + box.size / 2 + Vector3(0, 1, 0)
	var way = stylet.raycast(above, Vector3.DOWN)
	print("ray ", way > 0, " ", stylet.raycast(above, Vector3.UP))
	push(stylet, mesh, above + (way - 0.001) * Vector3.DOWN)
	quit()


# In a function of its own, as in insert.gd: a loop would keep the array of its last round, and
# Godot copies an array that has a second reference.
func draw(stylet, mesh):
	VisualServer.mesh_surface_update_region(mesh.get_rid(), 0, 0, stylet.surface())


# Godot draws the side from which the corners of a triangle go clockwise.
func outward(mesh):
	var arrays = mesh.surface_get_arrays(0)
	var places = arrays[Mesh.ARRAY_VERTEX]
	var corners = arrays[Mesh.ARRAY_INDEX]
	var volume = 0.0
	for i in range(0, corners.size(), 3):
		volume -= places[corners[i]].dot(places[corners[i + 1]].cross(places[corners[i + 2]])) / 6
	print("volume %.1f ml" % (1e6 * volume))


func push(stylet, mesh, tip):
	var pushed = 0
	for i in int(OS.get_environment("FRAMES")):
		stylet.move(tip + i * 1e-5 * Vector3.DOWN, Vector3.DOWN)
		stylet.tick(1)
		draw(stylet, mesh)
		pushed = max(pushed, stylet.force().y)
	print("needle ", stylet.needle().size(), " phase ", stylet.phase(), " pushed back ", pushed > 0.1)
	var state = stylet.state()
	stylet.reset()
	print("reset ", stylet.state() != state, " [", stylet.event(), "]")


func before_and_wrong():
	var stylet = Stylet.new()
	stylet.tick(3)
	print("before ", stylet.force(), " ", stylet.needle().size(), " ", stylet.surface().size())
	print("bytes: ", stylet.open(PoolByteArray([1, 2, 3]), {}, 0.001))
	print("words: ", stylet.open("liver", {}, 0.001))
	print("key: ", stylet.open(PoolByteArray(), {"lenght_m": 0.1}, 0.001))
	var file = File.new()
	file.open("res://liver.organ", File.READ)
	print("value: ", stylet.open(file.get_buffer(file.get_len()), {"length_m": 7}, 0.001))
	print("after ", stylet.needle().size(), " ", stylet.raycast(Vector3(0, 1, 0), Vector3.DOWN))
