# Draws a square with a shader that holds library.txt and calls two of its functions, so that it is compiled;
# Godot prints SHADER ERROR where it is not. Says "drawn" after it.
extends Node2D

func _ready():
	var file = File.new()
	file.open("res://library.txt", File.READ)
	var shader = Shader.new()
	shader.code = "shader_type canvas_item;\n" + file.get_as_text() + "\nvoid fragment() {\n" \
		+ "  COLOR = vec4(heightlight_bounced_rgb(UV.x, UV.y, COLOR.rgb), heightlight_cone_sh_8(UV.x, vec3(0.0, 0.0, 1.0)));\n}\n"
	var square = ColorRect.new()
	square.rect_size = Vector2(64, 64)
	square.material = ShaderMaterial.new()
	square.material.shader = shader
	add_child(square)
	yield(get_tree().create_timer(0.5), "timeout")
	print("drawn")
	get_tree().quit()
