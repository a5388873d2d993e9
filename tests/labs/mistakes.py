"""Wrong programs, as edits of the solutions: independent of check's own rules.

A mistake is a name and, for each lab where it can be made, its edits: (file's ending, old text, new
text). An old text that is missing is a fault of this file.
"""
import os

SOURCE = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
SOLUTIONS = os.path.join(SOURCE, "shaders/labs/solutions")
NAMES = {int(name[3:5]): name for name in sorted(os.listdir(SOLUTIONS))}
SHADERS = (1, 2, 4, 5, 6, 7, 8, 9, 10, 11)  # labs whose shaders the student writes
FRAGMENTS = (5, 6, 7, 8, 9, 10, 11)  # labs lit at the fragments

# Texts of the solutions.
HIGHP = "precision highp float;"
POSITION = "vec3(u_ModelMatrix * a_Position)"
START = "vec3 color = u_AmbientLight * v_Color.rgb;"
CLAMPED = "max(nDotL, 0.0)"
NORMAL = "vec3(u_NormalMatrix * vec4(a_Normal.xyz, 0.0))"
NORMAL_MATRIX = "uniform mat4 u_NormalMatrix;"
MAIN = "void main() {\n"
TO_LIGHT = {
    4: "normalize(u_LightPosition[i] - position)",
    5: "normalize(u_LightPosition[i] - v_Position)",
    6: "normalize(u_LightPosition[i] - v_Position)",
    7: "normalize(u_LightPosition[i] - v_Position)",
    8: "toLight / distance",
    9: "normalize(u_LightPosition - v_Position)",
    10: "normalize(u_LightPosition - v_Position)",
    11: "normalize(u_LightPosition - v_Position)",
}
COSINE = {
    1: "max(dot(u_LightDirection, normal), 0.0)",
    2: "max(dot(u_LightDirection[i], normal), 0.0)",
    4: "max(dot(lightDirection, normal), 0.0)",
    5: "max(dot(lightDirection, normal), 0.0)",
    9: "max(dot(normal, lightDirection), 0.0)",
    11: "max(dot(lightDirection, normal), 0.0)",
}
VIEW = "normalize(u_EyePosition - v_Position)"
LIT = "        if (nDotL > 0.0) {\n            color += u_LightColor[i] * v_Color.rgb * nDotL;\n"
OUT = {
    1: "v_Color = vec4(diffuse, a_Color.a);",
    2: "v_Color = vec4(light * a_Color.rgb, a_Color.a);",
    4: "v_Color = vec4(light * a_Color.rgb, a_Color.a);",
    5: "gl_FragColor = vec4(light * v_Color.rgb, v_Color.a);",
    6: "gl_FragColor = vec4(color, v_Color.a);",
    7: "gl_FragColor = vec4(color, v_Color.a);",
    8: "gl_FragColor = vec4(color, v_Color.a);",
    9: "gl_FragColor = vec4(light * color.rgb, color.a);",
    10: "gl_FragColor = vec4(color, v_Color.a);",
    11: "gl_FragColor = vec4(light * v_Color.rgb, v_Color.a);",
}
ATTENUATION = """1.0 / (u_Attenuation.x + u_Attenuation.y * distance +
                                   u_Attenuation.z * distance * distance)"""
# Lab 11.
SUM = "u_AmbientLight + visibility() * u_LightColor * nDotL"
PLACE = "0.5 * v_LightPosition.xyz / v_LightPosition.w + 0.5"
COMPARE = "place.z - BIAS <= mapDepth(place.xy)"
OUTSIDE = """    if (place.x < 0.0 || place.x > 1.0 || place.y < 0.0 || place.y > 1.0)
        return 1.0;
"""
PROJECT = "gl_Position = u_MvpMatrix * a_Position;"


def light_file(lab):
    """The file that computes the light."""
    return "frag" if lab in FRAGMENTS else "vert"


def edits(*pairs, file):
    """Edits of one file from (old, new) pairs; `file` may be a lab: the file with its light."""
    ending = light_file(file) if isinstance(file, int) else file
    return [(ending, old, new) for old, new in pairs]


def frag(old, new):
    return edits((old, new), file="frag")


def vert(old, new):
    return edits((old, new), file="vert")


def code(old, new):
    return edits((old, new), file="c")


def each(labs, made):
    """The same edits for several labs; `made` may be a function of the lab."""
    return {lab: made(lab) if callable(made) else made for lab in labs}


def with_uniform(beside, name, old, new):
    """Declares another matrix and uses it."""
    return vert(beside, f"{beside}\nuniform mat4 {name};") + vert(old, new)


def appended_to_position(statement):
    return vert(PROJECT, f"{PROJECT}\n    {statement}")


def to_light_reversed(lab):
    if lab in (1, 2):
        light = "u_LightDirection" + ("[i]" if lab == 2 else "")
        return vert(f"dot({light}, normal)", f"dot(-{light}, normal)")
    old = TO_LIGHT[lab]
    to, start = old[len("normalize(") : -1].split(" - ")
    return edits((old, f"normalize({start} - {to})"), file=lab)


def at_center(lab):
    """From the object's centre instead of the point."""
    start = TO_LIGHT[lab].split(" - ")[0]
    new = start + " - vec3(u_ModelMatrix * vec4(0.0, 0.0, 0.0, 1.0)))"
    light = "uniform vec3 u_LightColor"
    declared = frag(light, "uniform mat4 u_ModelMatrix;\n" + light) if lab in FRAGMENTS else []
    return edits((TO_LIGHT[lab], new), file=lab) + declared


def color_twice(lab):
    color = "a_Color.rgb" if lab in (1, 2, 4) else "color.rgb" if lab == 9 else "v_Color.rgb"
    if lab == 1:
        return vert(f"u_LightColor * {color}", f"u_LightColor * {color} * {color}")
    if lab in (2, 4, 5, 9, 11):
        return edits((OUT[lab], OUT[lab].replace(color, f"{color} * {color}")), file=lab)
    return vert("v_Color = a_Color;", "v_Color = a_Color * a_Color;")


def light_color_ignored(lab):
    if lab == 1:
        return vert("u_LightColor * a_Color", "a_Color")
    if lab in (6, 7):
        return sum((frag(f"u_LightColor[i] * {of}", of) for of in ("v_Color", "u_Specular")), [])
    if lab == 8:
        return frag("spot * u_LightColor *", "spot *")
    if lab in (9, 10, 11):
        return frag("u_LightColor * ", "")
    return edits(("light += u_LightColor[i] * nDotL", "light += vec3(nDotL)"), file=lab)


def gamma(lab):
    out = OUT[lab]
    inner = out[out.index("vec4(") + 5 : out.rindex(", ")]
    return edits((out, out.replace(inner, f"pow(max({inner}, 0.0), vec3(1.0 / 2.2))")), file=lab)


def view_edit(new):
    return each((6, 7, 8, 10), frag(VIEW, new))


def no_test_of_cosine(lab):
    """The highlight without N.L > 0; the diffuse light keeps its clamp."""
    if lab in (6, 7):
        return frag(LIT, LIT.replace("if (nDotL > 0.0) {", "{").replace("nDotL;", f"{CLAMPED};"))
    if lab == 8:
        return frag("if (nDotL > 0.0 && cosine", "if (cosine") + frag("* nDotL +", f"* {CLAMPED} +")
    return frag("if (nDotL > 0.0) {", "{") + frag("v_Color.rgb * nDotL", f"v_Color.rgb * {CLAMPED}")


def no_clamp(lab):
    if lab in (6, 7):
        test, sum_of_light = LIT.splitlines(keepends=True)
        return frag(LIT, sum_of_light[4:] + test)
    return edits((COSINE[lab], COSINE[lab][4:-6]), file=lab)


def ambient_per_light(lab):
    if lab in (6, 7):
        return frag(START, "vec3 color = vec3(0.0);") + frag(
            "        float nDotL = ",
            "        color += u_AmbientLight * v_Color.rgb;\n        float nDotL = ",
        )
    return edits(
        ("vec3 light = u_AmbientLight;", "vec3 light = vec3(0.0);"),
        ("light += u_LightColor[i] * nDotL", "light += u_AmbientLight + u_LightColor[i] * nDotL"),
        file=lab,
    )


def ambient_times_cosine(lab):
    if lab == 9:
        return frag(
            "u_AmbientLight + u_LightColor * nDotL", "(u_AmbientLight + u_LightColor) * nDotL"
        )
    if lab == 10:
        return frag(START, START.replace(";", f" * {CLAMPED};"))
    if lab == 11:
        return frag(SUM, SUM.replace("u_AmbientLight", "u_AmbientLight * nDotL"))
    return edits(
        ("vec3 light = u_AmbientLight;", "vec3 light = vec3(0.0);"),
        ("light += u_LightColor[i] * nDotL", "light += (u_AmbientLight + u_LightColor[i]) * nDotL"),
        file=lab,
    )


def no_ambient(lab):
    if lab in (2, 4, 5):
        return edits(("vec3 light = u_AmbientLight;", "vec3 light = vec3(0.0);"), file=lab)
    if lab == 9:
        return frag("u_AmbientLight + u_LightColor", "u_LightColor")
    if lab == 11:
        return frag(SUM, SUM.replace("u_AmbientLight + ", ""))
    return frag(START, "vec3 color = vec3(0.0);")


def specular_times(before, after=""):
    """The highlight with factors before or after u_SpecularColor."""
    old = "u_LightColor[i] * u_SpecularColor *"
    return {
        **each((6, 7), frag(old, f"{before}{old}{after}")),
        **each((8, 10), frag("u_SpecularColor * pow", f"{before}u_SpecularColor *{after} pow")),
    }


def gouraud(lab):
    """All of the light at the vertices."""
    text = read(lab)
    vertex, fragment = text[f"lab{lab:02}.vert"], text[f"lab{lab:02}.frag"]
    body = fragment[fragment.index(MAIN) + len(MAIN) :]
    for old, new in (
        ("normalize(v_Normal)", f"normalize({NORMAL})"),
        ("v_Position", "position"),
        ("v_Color", "a_Color"),
        ("gl_FragColor", "v_Color"),
    ):
        body = body.replace(old, new)
    uniforms = "".join(line + "\n" for line in fragment.splitlines() if line.startswith("uniform"))
    head = vertex[: vertex.index("varying")]
    start = f"    {PROJECT}\n    vec3 position = vec3(u_ModelMatrix * a_Position);\n"
    return vert(None, head + uniforms + "\nvarying vec4 v_Color;\n\n" + MAIN + start + body) + frag(
        None, f"{HIGHP}\nvarying vec4 v_Color;\n{MAIN}    gl_FragColor = v_Color;\n}}\n"
    )


def divided_at_vertices():
    """Lab 11's place on the map."""
    return edits(
        ("varying vec4 v_LightPosition", "varying vec3 v_LightPosition"),
        (PLACE, "0.5 * v_LightPosition + 0.5"),
        file="frag",
    ) + edits(
        ("varying vec4 v_LightPosition", "varying vec3 v_LightPosition"),
        (
            "v_LightPosition = u_LightMatrix * u_ModelMatrix * a_Position;",
            "vec4 p = u_LightMatrix * u_ModelMatrix * a_Position;\n    v_LightPosition = p.xyz / p.w;",
        ),
        file="vert",
    )


def read(lab):
    """A submission that is right; "_apart" and "_terms" are other forms of it."""
    folder = os.path.join(SOLUTIONS, NAMES[lab])
    texts = {}
    for name in sorted(name for name in os.listdir(folder) if "_" not in name):
        with open(os.path.join(folder, name)) as file:
            texts[name] = file.read()
    return texts


INVERSE = "mat4_transpose(inverse)"
ROTATE = "mat4_rotate(DEGREES_PER_SECOND * seconds, AXIS);"
MOVE, TURN, SCALE = "mat4_translate(PLACE)", "rotation", "mat4_scale(SCALE)"


def product(first, second, third):
    return f"mat4_product({first}, mat4_product({second}, {third}))"


def reordered(*parts):
    return {3: code(product(MOVE, TURN, SCALE), product(*parts))}


def before_inverse(*lines):
    """Lab 3: statements between the model matrix and its inverse."""
    old = "    Mat4 inverse;"
    return {3: code(old, "".join(f"    {line}\n" for line in lines) + old)}


REFLECTED = "2.0 * nDotL * normal - lightDirection"
HALFWAY = "vec3 halfway = normalize(lightDirection + viewDirection);"
REFLECT = "vec3 reflected = reflect(-lightDirection, normal);"
N_DOT_H, R_DOT_V = "max(dot(normal, halfway), 0.0)", "max(dot(reflected, viewDirection), 0.0)"
NOT_9, ROUND = (1, 2, 4, 5, 6, 7, 8, 10, 11), (4, 5, 6, 7, 8, 9, 11)
TURNED = (1, 2, *ROUND)

# The mistakes to be recognized; lab 3's under the names that `check` gives them where CALLED has no other.
MISTAKES = {
    "light direction reversed": each((1, 2, 4, 5, 6, 7, 9, 10, 11), to_light_reversed),
    "light direction not normalized": each(
        (4, 5, 6, 7, 9, 10, 11), lambda lab: edits((TO_LIGHT[lab], TO_LIGHT[lab][9:]), file=lab)
    ),
    "normal not normalized": {
        4: vert(f"normalize({NORMAL})", NORMAL),
        **each(
            (9, 11),
            vert(f"normalize({NORMAL})", NORMAL) + frag("normalize(v_Normal)", "v_Normal"),
        ),
    },
    "not renormalized per fragment": each((5, 6, 7, 8), frag("normalize(v_Normal)", "v_Normal")),
    "model matrix for normals": {
        3: code(INVERSE, "*world_from_model"),
        **each(ROUND, vert("u_NormalMatrix *", "u_ModelMatrix *")),
    },
    "inverse without transpose": {
        3: code(INVERSE, "inverse"),
        **each(
            TURNED,
            vert(
                "u_NormalMatrix * vec4(a_Normal.xyz, 0.0)",
                "vec4(a_Normal.xyz, 0.0) * u_NormalMatrix",
            ),
        ),
    },
    "transposed twice": {3: code(INVERSE, f"mat4_transpose({INVERSE})")},
    "normals not transformed": {
        3: code(INVERSE, "mat4_identity()"),
        **each(TURNED, vert(NORMAL, "a_Normal.xyz")),
    },
    "missing clamp": each((2, 4, 5, 6, 7, 9), no_clamp),
    "specular on the dark side": each((6, 7, 8, 10), no_test_of_cosine),
    "reflect's sign": {
        **each((6, 8), frag("reflect(-lightDirection", "reflect(lightDirection")),
        10: frag(REFLECTED, "lightDirection - 2.0 * nDotL * normal"),
    },
    "view vector from the wrong space": view_edit("normalize(-v_Position)"),
    "fixed view vector": view_edit("vec3(0.0, 0.0, 1.0)"),
    "normal in eye space": each(
        TURNED,
        with_uniform(
            NORMAL_MATRIX, "u_EyeNormalMatrix", "u_NormalMatrix *", "u_EyeNormalMatrix *"
        ),
    ),
    "position in eye space": each(
        (*ROUND, 10),
        with_uniform(
            "uniform mat4 u_ModelMatrix;",
            "u_ModelViewMatrix",
            POSITION,
            POSITION.replace("Model", "ModelView"),
        ),
    ),
    "w = 1 for a direction": {
        **each(
            (1, 2),
            vert(NORMAL_MATRIX, "uniform mat4 u_ModelMatrix;")
            + vert(NORMAL, "vec3(u_ModelMatrix * a_Normal)"),
        ),
        **each(ROUND, vert(NORMAL, "vec3(u_ModelMatrix * a_Normal)")),
    },
    "w = 0 for a point": each(
        ROUND, vert(POSITION, "vec3(u_ModelMatrix * vec4(a_Position.xyz, 0.0))")
    ),
    "light direction from the object's centre": each((4, 5, 6, 7, 9, 10, 11), at_center),
    "degrees for radians": {
        3: code(ROTATE, ROTATE.replace("* seconds", "* seconds * 3.14159265 / 180")),
        8: frag("cos(radians(u_SpotCutoff))", "cos(u_SpotCutoff)"),
    },
    "transposed": {
        **before_inverse("*world_from_model = mat4_transpose(*world_from_model);"),
        **each(SHADERS, vert("u_MvpMatrix * a_Position", "a_Position * u_MvpMatrix")),
    },
    "ambient added per light": each((2, 4, 5, 6, 7), ambient_per_light),
    "ambient multiplied by the cosine": each((2, 4, 5, 9, 10, 11), ambient_times_cosine),
    "ambient missing": each((2, 4, 5, 6, 7, 8, 9, 10, 11), no_ambient),
    "colour used twice": each(SHADERS, color_twice),
    "light colour ignored": each(SHADERS, light_color_ignored),
    "attenuation by the square": {
        8: edits(
            (
                "    float cosine = ",
                "    float square = distance * distance;\n    float cosine = ",
            ),
            ("u_Attenuation.y * distance +", "u_Attenuation.y * square +"),
            ("u_Attenuation.z * distance * distance", "u_Attenuation.z * square * square"),
            file="frag",
        )
    },
    "attenuation by the inverse square": {8: frag(ATTENUATION, "1.0 / (distance * distance)")},
    "attenuation inverted": {8: frag("1.0 / (u_Attenuation.x", "(u_Attenuation.x")},
    "attenuation missing": {8: frag("attenuation * spot", "spot")},
    "angle compared with a cosine": {
        8: frag("cosine >= cos(radians(u_SpotCutoff))", "cosine >= radians(u_SpotCutoff)")
    },
    "no soft edge": {8: frag("attenuation * spot", "attenuation")},
    "no cutoff": {8: frag(" && cosine >= cos(radians(u_SpotCutoff))", "")},
    "front faces culled": each(NOT_9, frag(MAIN, f"{MAIN}    if (gl_FrontFacing) discard;\n")),
    "depth reversed": each(TURNED, appended_to_position("gl_Position.z = -gl_Position.z;")),
    "no depth test": each(TURNED, appended_to_position("gl_Position.z = 0.0;")),
    "upside down": each(NOT_9, appended_to_position("gl_Position.y = -gl_Position.y;")),
    "aspect ratio ignored": each(
        SHADERS,
        vert(
            "uniform mat4 u_MvpMatrix;",
            "uniform mat4 u_MvpMatrix;\nuniform mat4 u_ProjMatrix;\n"
            "uniform mat4 u_ModelViewMatrix;",
        )
        + vert(
            PROJECT,
            "mat4 projection = u_ProjMatrix;\n    projection[0][0] = projection[1][1];\n"
            "    gl_Position = projection * u_ModelViewMatrix * a_Position;",
        ),
    ),
    "mediump overflow": each((5, 6, 7, 8, 9, 11), frag(HIGHP, "precision mediump float;")),
    "pow of a negative number": {
        **each((6, 8), frag(R_DOT_V, R_DOT_V[4:-6])),
        10: frag(f"max(dot({REFLECTED}, viewDirection), 0.0)", f"dot({REFLECTED}, viewDirection)"),
    },
    "half vector not normalized": {7: frag(HALFWAY[15:-1], HALFWAY[24:-1] + " / 2.0")},
    "shininess not fitted": {7: frag("4.0 * u_Shininess + 1.3", "u_Shininess")},
    "Phong for Blinn-Phong": {
        7: frag(HALFWAY, REFLECT)
        + frag(N_DOT_H, R_DOT_V)
        + frag("pow(nDotH, shininess)", "pow(nDotH, u_Shininess)")
    },
    "Blinn-Phong for Phong": each((6, 8), frag(REFLECT, HALFWAY) + frag(R_DOT_V, N_DOT_H)),
    "highlight in the object's colour": specular_times("", " v_Color.rgb *"),
    "no highlight": specular_times("0.0 * "),
    "light at the vertices": each((5, 6, 7, 8), gouraud),
    "only the first light": each((2, 4, 5, 6, 7), lambda lab: edits(("i < 2", "i < 1"), file=lab)),
    "extra gamma": each(SHADERS, gamma),
    "front and back swapped in a mirror": {
        9: frag("gl_FrontFacing == (u_Mirrored > 0.0)", "gl_FrontFacing")
    },
    "back's normal not reversed": {9: frag("        normal = -normal;\n", "")},
    "back in the front's colour": {9: frag("        color = u_BackColor;\n", "")},
    "front and back swapped": {9: frag("if (!front)", "if (front)")},
    "no bias: shadow acne": {11: frag("place.z - BIAS", "place.z")},
    "all that the map shows in shadow": {11: frag("place.z - BIAS", "place.z + BIAS")},
    "bias too large": {11: frag("BIAS = 0.002", "BIAS = 0.06")},
    "not divided by w": {11: frag(PLACE, "0.5 * v_LightPosition.xyz + 0.5")},
    "range from -1 to 1": {11: frag(PLACE, "v_LightPosition.xyz / v_LightPosition.w")},
    "map upside down": {
        11: frag("mapDepth(place.xy)", "mapDepth(vec2(place.x, 1.0 - place.y))")
    },
    "map mirrored": {11: frag("mapDepth(place.xy)", "mapDepth(vec2(1.0 - place.x, place.y))")},
    "place on the map from the wrong space": {
        11: vert("u_LightMatrix * u_ModelMatrix * a_Position", "u_LightMatrix * a_Position")
    },
    "depth of one channel": {
        11: frag(
            "dot(texture2D(u_ShadowMap, place).rgb, vec3(1.0, 1.0 / 255.0, 1.0 / 65025.0))",
            "texture2D(u_ShadowMap, place).r",
        )
    },
    "comparison inverted": {11: frag("<= mapDepth", "> mapDepth")},
    "no shadow": {11: frag(SUM, SUM.replace("visibility() * ", ""))},
    "outside of the map not asked for": {11: frag(OUTSIDE, "")},
    "outside of the map dark": {11: frag(OUTSIDE, OUTSIDE.replace("1.0;", "0.0;"))},
    "shadows keep off the ambient light, too": {
        11: frag(SUM, "visibility() * (u_AmbientLight + u_LightColor * nDotL)")
    },
    "shadow on the ambient light only": {
        11: frag(SUM, "visibility() * u_AmbientLight + u_LightColor * nDotL")
    },
    "light in the shadow": {11: frag("1.0 : 0.0", "1.0 : 0.4")},
    "shadow darker than none": {11: frag("1.0 : 0.0", "1.0 : -0.125")},
    "wrong weights of the map's texels": {11: frag("1.0 : 0.0", "1.5 : 0.0")},
    "divided by w at the vertices": {11: divided_at_vertices()},
    "components of the place swapped": {11: frag("mapDepth(place.xy)", "mapDepth(place.yx)")},
    "channels of the depth in the wrong order": {11: frag("place).rgb", "place).bgr")},
    "outside of the map in another range": {
        11: frag(OUTSIDE, "    if (abs(place.x) > 1.0 || abs(place.y) > 1.0)\n        return 1.0;\n")
    },
    "turned the wrong way": {
        3: code(ROTATE, f"{ROTATE}\n    rotation = mat4_transpose(rotation);")
    },
    "moved before it is turned": reordered(TURN, MOVE, SCALE),
    "turned before it is scaled": reordered(MOVE, SCALE, TURN),
    "product in the reverse order": reordered(SCALE, TURN, MOVE),
    "not turned": {3: code("DEGREES_PER_SECOND = 30", "DEGREES_PER_SECOND = 0")},
    "not moved": {3: code("PLACE = {0.5, 0.3, -0.8}", "PLACE = {0, 0, 0}")},
    "not scaled": {3: code("SCALE = {2, 0.7, 1.2}", "SCALE = {1, 1, 1}")},
    "moved the wrong way": {3: code("PLACE = {0.5, 0.3, -0.8}", "PLACE = {-0.5, -0.3, 0.8}")},
    "scaled inversely": {3: code("SCALE = {2, 0.7, 1.2}", "SCALE = {0.5, 1 / 0.7, 1 / 1.2}")},
    "turned about another axis": {3: code("AXIS = {1, 2, 0.5}", "AXIS = {0, 1, 0}")},
    "model matrix inverted": before_inverse(
        "Mat4 world = *world_from_model;", "mat4_inverse(world, world_from_model);"
    ),
}

ALONE = {"light at the vertices"}  # replaces the whole text: no pairs

# The names that `check` may give instead to lab 3's.
CALLED = {
    "transposed twice": {"inverse without transpose"},
    "transposed": {"model matrix transposed"},
    "turned about another axis": {"wrong axis"},
}


def applied(texts, lab, made):
    """The texts with these edits; None if a text to replace is missing."""
    texts = dict(texts)
    for ending, old, new in made:
        name = next(n for n in texts if n.endswith("." + ending))
        if old is None:
            texts[name] = new
        elif old not in texts[name]:
            return None
        else:
            texts[name] = texts[name].replace(old, new)
    return texts


def as_the_lecture(texts):
    """Without normalizing at the vertices what is lit at the fragments: equally right."""
    return {
        name: text.replace(f"v_Normal = normalize({NORMAL})", f"v_Normal = {NORMAL}")
        for name, text in texts.items()
    }


def single(lab, name, lecture=False):
    texts = applied(read(lab), lab, MISTAKES[name][lab])
    assert texts is not None, f"{NAMES[lab]}: {name}: its text is not in the solution"
    return as_the_lecture(texts) if lecture else texts


def of_lab(lab):
    return [name for name, labs in MISTAKES.items() if lab in labs]


def pair(lab, first, second, lecture=False):
    """Both mistakes in one text; None if they touch the same place."""

    def in_order(*names):
        texts = read(lab)
        for name in names:
            texts = texts and applied(texts, lab, MISTAKES[name][lab])
        return texts

    both = None if {first, second} & ALONE else in_order(first, second)
    if not both or both != in_order(second, first):
        return None
    return as_the_lecture(both) if lecture else both


# Wrong in other ways: what replaces the solution's last line. Naming any mistake here is a false
# accusation.
NOISE = "fract(sin(dot(gl_FragCoord.xy, vec2(12.9898, 78.233))) * 43758.5453)"
ART = {
    "grey": (5, "gl_FragColor = vec4(0.5, 0.5, 0.5, 1.0);"),
    "red": (6, "gl_FragColor = vec4(0.9, 0.1, 0.0, 1.0);"),
    "white": (7, "gl_FragColor = vec4(1.0);"),
    "normal as colour": (5, "gl_FragColor = vec4(normal * 0.5 + 0.5, 1.0);"),
    "position as colour": (6, "gl_FragColor = vec4(fract(v_Position), 1.0);"),
    "chequers": (
        7,
        "vec2 square = floor(gl_FragCoord.xy / 8.0);\n"
        "    gl_FragColor = vec4(vec3(mod(square.x + square.y, 2.0)), 1.0);",
    ),
    "stripes": (
        5,
        "gl_FragColor = vec4(light * v_Color.rgb * (0.5 + 0.5 * sin(20.0 * v_Position.y)), 1.0);",
    ),
    "noise": (6, f"gl_FragColor = vec4(vec3({NOISE}), 1.0);"),
    "noise on what is right": (
        5,
        f"gl_FragColor = vec4(light * v_Color.rgb + 0.2 * {NOISE}, 1.0);",
    ),
    "depth as grey": (9, "gl_FragColor = vec4(vec3(gl_FragCoord.z), 1.0);"),
    "rim light": (
        6,
        "gl_FragColor = vec4(color + vec3(1.0 - max(dot(normal, viewDirection), 0.0)), 1.0);",
    ),
    "toon": (5, "gl_FragColor = vec4(floor(light * 4.0) / 4.0 * v_Color.rgb, 1.0);"),
    "vignette": (
        10,
        "gl_FragColor = vec4(color * (1.0 - 0.005 * abs(gl_FragCoord.x - 48.0)), 1.0);",
    ),
    "rings": (8, "gl_FragColor = vec4(color * step(0.5, fract(4.0 * length(v_Position))), 1.0);"),
    "holes": (
        7,
        "if (mod(floor(gl_FragCoord.x) + floor(gl_FragCoord.y), 2.0) > 0.5) discard;\n"
        "    gl_FragColor = vec4(color, 1.0);",
    ),
    "posterized": (6, "gl_FragColor = vec4(step(0.5, color), 1.0);"),
    "brighter to the right": (
        9,
        "gl_FragColor = vec4(light * color.rgb * (0.5 + 0.01 * gl_FragCoord.x), 1.0);",
    ),
    "normals as colours": (2, "v_Color = vec4(abs(a_Normal.xyz), 1.0);"),
}


def art(name):
    lab, text = ART[name]
    return lab, applied(read(lab), lab, [(light_file(lab), OUT[lab], text)])
