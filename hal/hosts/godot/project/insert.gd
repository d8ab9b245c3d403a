# SPDX-License-Identifier: Apache-2.0
# A needle in an organ: Down pushes it in, Up pulls it out, 10 mm/s. The label shows the force.
extends Spatial

const Stylet = preload("res://stylet.gdns")
const TICKS = 10     # of 1 ms in a frame of physics
const SPEED = 0.010  # m/s

onready var mesh = ArrayMesh.new()
var stylet = Stylet.new()
var tip = Vector3()


func _ready():
	var file = File.new()
	if file.open("res://liver.organ", File.READ) != OK:
		return stop("res://liver.organ cannot be read: copy an organ there")
	var refused = stylet.open(file.get_buffer(file.get_len()), {"bending_nm2": 0.02}, 0.001)
	if refused != "":
		return stop(refused)
	var box = stylet.box()
	tip = box.position + box.size / 2
	tip.y = box.end.y + 0.01
	tip.y -= stylet.raycast(tip, Vector3.DOWN) - 0.001  # the tip begins 1 mm above the skin
	# Without compression, so that surface() has the bytes that Godot keeps.
	mesh.add_surface_from_arrays(Mesh.PRIMITIVE_TRIANGLES, stylet.mesh(), [], 0)
	mesh.custom_aabb = box.grow(0.05)
	$Organ.mesh = mesh
	# So far that the organ and a needle of 15 cm fill the window.
	var away = Vector3(1, 1, 2).normalized() * (0.1 + 0.6 * box.size.length())
	$Camera.look_at_from_position(tip + away, tip, Vector3.UP)


func stop(why):
	printerr(why)
	set_physics_process(false)
	get_tree().quit(1)


func wanted():  # 1: in, -1: out
	return int(Input.is_action_pressed("ui_down")) - int(Input.is_action_pressed("ui_up"))


func _physics_process(delta):
	tip += wanted() * SPEED * delta * Vector3.DOWN
	stylet.move(tip, Vector3.DOWN)
	stylet.tick(TICKS)
	show_all()


func show_all():
	VisualServer.mesh_surface_update_region(mesh.get_rid(), 0, 0, stylet.surface())
	$Needle.clear()
	$Needle.begin(Mesh.PRIMITIVE_LINE_STRIP)
	for node in stylet.needle():
		$Needle.add_vertex(node)
	$Needle.end()
	$Force.text = "%.2f N  %.1f mm  %s" % [
			stylet.force().length(), 1000 * stylet.depth(), stylet.event()]
