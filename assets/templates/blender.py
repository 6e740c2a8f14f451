"""A scene for Blender 3.4 to 3.6 (Cycles), by tyndall convert. It was tried with 3.4.1.

blender -b --factory-startup -P THIS.py                           builds the scene
blender -b --factory-startup -P THIS.py -- OUTPUT.exr [SAMPLES]   and renders it

Conventions: Blender's z is our y, its -y our z; a refractive index is inside over outside by the side of the normal, so a
sphere of negative radius has its faces turned; bounces are our scattering events less one; colours are linear Rec.709;
emission strength 1 is radiance 1. Spheres are meshes of 256 x 128 faces with smooth normals, disks of 1024 sides.
"""
DATA = {{scene}}

import array
import json
import math
import os
import sys

import bpy
from mathutils import Matrix, Vector

scene = json.loads(DATA)


def world(p):
    """From our axes (y up) to Blender's (z up)."""
    return Vector((p[0], -p[2], p[1]))


def new_tree(tree):
    tree.nodes.clear()
    return tree


def node(tree, kind, links=(), **values):
    """A node; values by the names of its inputs or attributes; links: (input, output of another node)."""
    made = tree.nodes.new(kind)
    for name, value in values.items():
        setattr(made, name, value)
    for to, source in links:
        if hasattr(source, "is_output"):
            tree.links.new(made.inputs[to], source)
        else:
            made.inputs[to].default_value = source
    return made


def math_node(tree, operation, *arguments):
    return node(tree, "ShaderNodeMath", enumerate(arguments), operation=operation).outputs[0]


def rgba(colour):
    return (*colour, 1.0)


def mixed(tree, factor, low, high):
    return node(tree, "ShaderNodeMixRGB", [("Fac", factor), ("Color1", rgba(low)), ("Color2", rgba(high))]).outputs[0]


def checker(tree, texture):
    position = node(tree, "ShaderNodeNewGeometry").outputs["Position"]
    axes = node(tree, "ShaderNodeSeparateXYZ", [("Vector", position)]).outputs
    ours = [axes["X"], axes["Z"], math_node(tree, "MULTIPLY", axes["Y"], -1.0)]
    cells = [math_node(tree, "FLOOR", math_node(tree, "DIVIDE", axis, texture["scale"])) for axis in ours]
    total = math_node(tree, "ADD", math_node(tree, "ADD", cells[0], cells[1]), cells[2])
    odd = math_node(tree, "GREATER_THAN", math_node(tree, "FRACT", math_node(tree, "MULTIPLY", total, 0.5)), 0.25)
    return mixed(tree, odd, texture["even"], texture["odd"])


def picture_in(file):
    """A PFM beside this script: linear, rows from below."""
    with open(os.path.join(os.path.dirname(os.path.abspath(__file__)), file), "rb") as data:
        data.readline()
        width, height = map(int, data.readline().split())
        little = float(data.readline()) < 0
        values = array.array("f", data.read())
    if little != (sys.byteorder == "little"):
        values.byteswap()
    pixels = array.array("f", [1.0]) * (4 * width * height)
    for channel in range(3):
        pixels[channel::4] = values[channel::3]
    made = bpy.data.images.new(file, width, height, float_buffer=True)
    made.pixels.foreach_set(pixels)
    made.pack()
    return made


def picture(tree, texture, round_shape):
    """Around spheres u goes on from 1 to 0; v, and u elsewhere, end in the middle of the last pixel."""
    image = picture_in(texture["file"])
    at = node(tree, "ShaderNodeTexCoord").outputs["UV"]
    if round_shape:
        edge = 0.5 / image.size[1]
        for operation, limit in (("MAXIMUM", (-1.0, edge, 0.0)), ("MINIMUM", (2.0, 1.0 - edge, 0.0))):
            at = node(tree, "ShaderNodeVectorMath", [(0, at), (1, limit)], operation=operation).outputs[0]
    made = node(tree, "ShaderNodeTexImage", [("Vector", at)], interpolation="Linear",
                extension="REPEAT" if round_shape else "EXTEND")
    made.image = image
    return made.outputs["Color"]


def colour_of(tree, material, round_shape):
    if "texture" not in material:
        return rgba(material["colour"])
    texture = scene["textures"][material["texture"]]
    if texture["type"] == "solid":
        return rgba(texture["color"])
    if texture["type"] == "checker":
        return checker(tree, texture)
    return picture(tree, texture, round_shape)


def surface(tree, material, round_shape):
    kind = material["type"]
    if kind == "dielectric":
        values = [("Color", (1, 1, 1, 1)), ("Roughness", 0.0), ("IOR", material["refractive_index"])]
        return node(tree, "ShaderNodeBsdfGlass", values, distribution="GGX")
    colour = colour_of(tree, material, round_shape)
    if kind == "metal":
        glossy = "ShaderNodeBsdfGlossy" if hasattr(bpy.types, "ShaderNodeBsdfGlossy") else "ShaderNodeBsdfAnisotropic"
        return node(tree, glossy, [("Color", colour), ("Roughness", 0.0)], distribution="GGX")
    if kind == "light":
        return node(tree, "ShaderNodeEmission", [("Color", colour), ("Strength", 1.0)])
    return node(tree, "ShaderNodeBsdfDiffuse", [("Color", colour), ("Roughness", 0.0)])


def volume(tree, medium):
    values = [("Color", rgba(medium["albedo"])), ("Density", medium["sigma_t"])]
    scattering = node(tree, "ShaderNodeVolumeScatter", [*values, ("Anisotropy", medium["g"])])
    absorption = node(tree, "ShaderNodeVolumeAbsorption", values)
    return node(tree, "ShaderNodeAddShader", [(0, scattering.outputs[0]), (1, absorption.outputs[0])])


MATERIALS = {}


def material_of(shape):
    key = (shape["material"], shape["medium"], "radius" in shape)
    if key not in MATERIALS:
        ours = scene["materials"][shape["material"]] if shape["material"] >= 0 else None
        made = bpy.data.materials.new(ours["name"] if ours else "medium")
        made.use_nodes = True
        tree = new_tree(made.node_tree)
        output = tree.nodes.new("ShaderNodeOutputMaterial")
        if ours:
            tree.links.new(output.inputs["Surface"], surface(tree, ours, "radius" in shape).outputs[0])
        if shape["medium"] >= 0:
            tree.links.new(output.inputs["Volume"], volume(tree, scene["media"][shape["medium"]]).outputs[0])
        made.cycles.homogeneous_volume = True
        MATERIALS[key] = made
    return MATERIALS[key]


SPHERES = {}
SEGMENTS, RINGS = 256, 128


def sphere_mesh(radius, inward):
    """A sphere of radius 1 whose pole is z. Of a large one only the part around the pole is near: rings crowd there."""
    grading = max(0.0, math.log(radius / 5))
    if (grading, inward) in SPHERES:
        return SPHERES[grading, inward]
    angles = [math.pi * k / RINGS * math.exp(grading * (k / RINGS - 1)) for k in range(RINGS + 1)]
    points, faces, uvs = [], [], []
    for angle in angles:
        for s in range(SEGMENTS):
            turn = 2 * math.pi * s / SEGMENTS - math.pi
            points.append((math.sin(angle) * math.cos(turn), math.sin(angle) * math.sin(turn), math.cos(angle)))
    for r in range(RINGS):
        for s in range(SEGMENTS):
            a, b = r * SEGMENTS + s, r * SEGMENTS + (s + 1) % SEGMENTS
            corners = [(a, s, r), (a + SEGMENTS, s, r + 1), (b + SEGMENTS, s + 1, r + 1), (b, s + 1, r)]
            if r == 0:
                corners = corners[:3]
            elif r == RINGS - 1:
                corners = [corners[0], corners[1], corners[3]]
            if inward:
                corners.reverse()
            faces.append([c[0] for c in corners])
            uvs.extend((c[1] / SEGMENTS, 1 - c[2] / RINGS) for c in corners)
    mesh = bpy.data.meshes.new("sphere")
    mesh.from_pydata(points, [], faces)
    layer = mesh.uv_layers.new()
    for data, uv in zip(layer.data, uvs):
        data.uv = uv
    mesh.polygons.foreach_set("use_smooth", [True] * len(mesh.polygons))
    mesh.materials.append(None)
    SPHERES[grading, inward] = mesh
    return mesh


def add(name, mesh, shape):
    thing = bpy.data.objects.new(name, mesh)
    bpy.context.collection.objects.link(thing)
    thing.material_slots[0].link = "OBJECT"
    thing.material_slots[0].material = material_of(shape)
    return thing


def has_image(shape):
    material = scene["materials"][shape["material"]] if shape["material"] >= 0 else {}
    return "texture" in material and scene["textures"][material["texture"]]["type"] == "image"


def add_sphere(shape):
    thing = add("sphere", sphere_mesh(shape["radius"], shape["inward"]), shape)
    thing.scale = [shape["radius"]] * 3
    if has_image(shape):
        thing.rotation_euler = (0, 0, math.radians(shape["degrees"]))
    else:
        middle = Vector(scene["camera"]["at"]) + scene["camera"]["focus"] * Vector(scene["camera"]["forward"])
        thing.rotation_mode = "QUATERNION"
        thing.rotation_quaternion = world(middle - Vector(shape["center"])).to_track_quat("Z", "Y")
    opens, closes = scene["camera"]["shutter"]
    if shape["center"] == shape["center_end"]:
        thing.location = world(shape["center"])
        return
    for time, at in ((0, "center"), (1, "center_end")):
        thing.location = world(shape[at])
        thing.keyframe_insert("location", frame=time - opens)
    for curve in curves_of(thing.animation_data.action):
        for key in curve.keyframe_points:
            key.interpolation = "LINEAR"


def curves_of(action):
    """Newer versions keep them in layers."""
    if hasattr(action, "fcurves"):
        return action.fcurves
    return [curve for layer in action.layers for strip in layer.strips for bag in strip.channelbags
            for curve in bag.fcurves]


def add_mesh(name, points, faces, uvs, shape):
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(points, [], faces)
    layer = mesh.uv_layers.new()
    for data, uv in zip(layer.data, uvs):
        data.uv = uv
    mesh.materials.append(None)
    add(name, mesh, shape)


def add_quads(shape):
    points, faces = [], []
    for corner, u, v, _ in shape["quads"]:
        corner, u, v = world(corner), world(u), world(v)
        faces.append(list(range(len(points), len(points) + 4)))
        points += [corner, corner + u, corner + u + v, corner + v]
    add_mesh("quads", points, faces, [(0, 0), (1, 0), (1, 1), (0, 1)] * len(faces), shape)


def add_triangle(shape):
    corner, u, v = map(world, shape["triangles"][0][:3])
    add_mesh("triangle", [corner, corner + u, corner + v], [[0, 1, 2]], [(0, 0), (1, 0), (0, 1)], shape)


SIDES = 1024


def add_disk(shape):
    *place, inner = shape["disks"][0]
    center, u, v = map(world, place)
    # The polygon has the area of the disk.
    full = math.sqrt(2 * math.pi / SIDES / math.sin(2 * math.pi / SIDES))
    rims = [[center + radius * full * (math.cos(a) * u + math.sin(a) * v)
             for a in (2 * math.pi * k / SIDES for k in range(SIDES))]
            for radius in (1.0, inner) if radius > 0]
    if len(rims) == 1:
        faces = [list(range(SIDES))]
    else:
        faces = [[k, (k + 1) % SIDES, SIDES + (k + 1) % SIDES, SIDES + k] for k in range(SIDES)]
    add_mesh("disk", [point for rim in rims for point in rim], faces, [], shape)


def add_camera():
    camera = scene["camera"]
    data = bpy.data.cameras.new("camera")
    data.sensor_fit = "VERTICAL"
    data.angle = math.radians(camera["vfov"])
    data.clip_start, data.clip_end = 1e-4 * camera["focus"], 1e8 * camera["focus"]
    if camera["lens_radius"] > 0:
        data.dof.use_dof = True
        data.dof.focus_distance = camera["focus"]
        data.dof.aperture_fstop = 1e-3 * data.lens / (2 * camera["lens_radius"])
    thing = bpy.data.objects.new("camera", data)
    right, up, back = world(camera["right"]), world(camera["up"]), -world(camera["forward"])
    thing.matrix_world = Matrix((right, up, back)).transposed().to_4x4()
    thing.matrix_world.translation = world(camera["at"])
    bpy.context.collection.objects.link(thing)
    bpy.context.scene.camera = thing


def add_background():
    world_data = bpy.data.worlds.new("background")
    bpy.context.scene.world = world_data
    world_data.use_nodes = True
    tree = new_tree(world_data.node_tree)
    sky = scene["background"]
    strength = sky.get("scale", 1.0)
    if sky["type"] == "image":
        # Blender's picture begins a quarter of a turn before ours.
        angle = math.radians(-90.0 - sky["rotate_y"])
        direction = node(tree, "ShaderNodeTexCoord").outputs["Generated"]
        turned = node(tree, "ShaderNodeVectorRotate", [("Vector", direction), ("Angle", angle)], rotation_type="Z_AXIS")
        made = node(tree, "ShaderNodeTexEnvironment", [("Vector", turned.outputs[0])], interpolation="Linear")
        made.image = picture_in(sky["file"])
        colour = made.outputs["Color"]
    elif sky["type"] == "constant":
        colour = rgba(sky["color"])
    else:
        direction = node(tree, "ShaderNodeTexCoord").outputs["Generated"]
        height = node(tree, "ShaderNodeSeparateXYZ", [("Vector", direction)]).outputs["Z"]
        if sky["type"] == "gradient":
            colour = mixed(tree, math_node(tree, "MULTIPLY_ADD", height, 0.5, 0.5), sky["bottom"], sky["top"])
        else:
            colour = mixed(tree, math_node(tree, "GREATER_THAN", height, 0.0), sky["down"], sky["up"])
    shader = node(tree, "ShaderNodeBackground", [("Color", colour), ("Strength", strength)])
    output = tree.nodes.new("ShaderNodeOutputWorld")
    tree.links.new(output.inputs["Surface"], shader.outputs[0])


def set_up_render():
    to = bpy.context.scene
    to.render.engine = "CYCLES"
    to.render.resolution_x, to.render.resolution_y = scene["width"], scene["height"]
    to.render.resolution_percentage = 100
    image = to.render.image_settings
    image.file_format, image.color_mode, image.color_depth, image.exr_codec = "OPEN_EXR", "RGB", "32", "NONE"
    to.render.use_compositing = to.render.use_sequencer = False
    cycles = to.cycles
    cycles.device, cycles.samples, cycles.seed = "CPU", scene["spp"], scene["seed"]
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.pixel_filter_type, cycles.filter_width = "BOX", 1.0
    bounces = min(scene["max_depth"] - 1, 1024)
    for name in ("max", "diffuse", "glossy", "transmission", "volume"):
        setattr(cycles, name + "_bounces", bounces)
    cycles.transparent_max_bounces = 1024
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = cycles.light_sampling_threshold = 0
    cycles.caustics_reflective = cycles.caustics_refractive = True
    cycles.blur_glossy = 0
    opens, closes = scene["camera"]["shutter"]
    to.frame_set(0)
    if closes > opens:
        to.render.use_motion_blur = True
        to.render.motion_blur_shutter = closes - opens
        cycles.motion_blur_position = "START"


bpy.ops.wm.read_factory_settings(use_empty=True)
for each in scene["shapes"]:
    kinds = {"radius": add_sphere, "quads": add_quads, "triangles": add_triangle, "disks": add_disk}
    next(make for key, make in kinds.items() if key in each)(each)
add_camera()
add_background()
set_up_render()
ARGUMENTS = sys.argv[sys.argv.index("--") + 1:] if "--" in sys.argv else []
if ARGUMENTS and ARGUMENTS[0].endswith(".exr"):
    if len(ARGUMENTS) > 1:
        bpy.context.scene.cycles.samples = int(ARGUMENTS[1])
    bpy.context.scene.render.filepath = os.path.abspath(ARGUMENTS[0])
    bpy.ops.render.render(write_still=True)
