# SPDX-License-Identifier: Apache-2.0
# A needle in an organ: Down pushes it in, Up pulls it out, 10 mm/s. The label shows the force.
# With the environment variable STYLET_INSERT_LOG it goes 20 mm in by itself, writes the tip's place
# and the force of every frame into that file, and ends.
extends Spatial

const Stylet = preload("res://stylet.gdns")
const TICKS = 10       # of 1 ms in a frame of physics
const SPEED = 0.010    # m/s
const AUTOMATIC = 210  # frames

onready var mesh = ArrayMesh.new()
var stylet = Stylet.new()
var start = Vector3()
var gone = 0.0
var frame = 0
var log_file = null


func _ready():
	var file = File.new()
	if file.open("res://liver.organ", File.READ) != OK:
		return stop("res://liver.organ cannot be read: copy an organ there")
	var refused = stylet.open(file.get_buffer(file.get_len()), {"bending_nm2": 0.02}, 0.001)
	if refused != "":
		return stop(refused)
	var box = stylet.box()
	start = box.position + box.size / 2
	start.y = box.end.y + 0.01
	start.y -= stylet.raycast(start, Vector3.DOWN) - 0.001  # the tip begins 1 mm above the skin
	# Without compression, so that surface() has the bytes that Godot keeps.
	mesh.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, stylet.mesh(), [], 0)
	mesh.custom_aabb = box.grow(0.05)
	$Organ.mesh = mesh
	$Organ.material_override = material(Color(0.7, 0.35, 0.3))
	$Needle.material_override = material(Color(1, 1, 1))
	$Needle.material_override.flags_unshaded = true  # a line has no side that light could fall on
	# So far that the organ and a needle of 15 cm fill the window.
	var away = Vector3(1, 1, 2).normalized() * (0.1 + 0.6 * box.size.length())
	$Camera.look_at_from_position(start + away, start, Vector3.UP)
	if OS.has_environment("STYLET_INSERT_LOG"):
		log_file = File.new()
		if log_file.open(OS.get_environment("STYLET_INSERT_LOG"), File.WRITE) != OK:
			stop("STYLET_INSERT_LOG cannot be written")


func stop(why):
	printerr(why)
	set_physics_process(false)
	get_tree().quit(1)


func material(colour):
	var made = SpatialMaterial.new()
	made.albedo_color = colour
	made.params_cull_mode = SpatialMaterial.CULL_DISABLED
	return made


func _physics_process(delta):
	if log_file != null or Input.is_action_pressed("ui_down"):
		gone += SPEED * delta
	elif Input.is_action_pressed("ui_up"):
		gone -= SPEED * delta
	var tip = start + gone * Vector3.DOWN
	stylet.move(tip, Vector3.DOWN)
	stylet.tick(TICKS)
	show_all()
	if log_file != null:
		note(tip)


func show_all():
	VisualServer.mesh_surface_update_region(mesh.get_rid(), 0, 0, stylet.surface())
	$Needle.clear()
	$Needle.begin(Mesh.PRIMITIVE_LINE_STRIP)
	for node in stylet.needle():
		$Needle.add_vertex(node)
	$Needle.end()
	$Force.text = "%.2f N  %.1f mm  %s" % [
			stylet.force().length(), 1000 * stylet.depth(), stylet.event()]


func note(tip):
	# As bytes: a text would round them.
	for vector in [tip, stylet.force()]:
		for axis in 3:
			log_file.store_float(vector[axis])
	frame += 1
	if frame < AUTOMATIC:
		return
	log_file.close()
	print("state ", stylet.state(), " ", stylet.event())
	get_tree().quit()
