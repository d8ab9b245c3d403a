# SPDX-License-Identifier: Apache-2.0
# The project's scene without a hand: the needle goes 20 mm in, tip and force of every frame go into
# the file that STYLET_INSERT_LOG names, and it ends.
extends "res://insert.gd"

const FRAMES = 210

var frame = 0
var log_file = File.new()


func wanted():
	return 1


func show_all():
	.show_all()
	if frame == 0 and log_file.open(OS.get_environment("STYLET_INSERT_LOG"), File.WRITE) != OK:
		return stop("STYLET_INSERT_LOG cannot be written")
	# As bytes: a text would round them.
	for vector in [tip, stylet.force()]:
		for axis in 3:
			log_file.store_float(vector[axis])
	frame += 1
	if frame < FRAMES:
		return
	log_file.close()
	print("state ", stylet.state(), " ", stylet.event())
	get_tree().quit()
