"""Wrong programs, as edits of the solutions' texts: what students do, not what `check` knows.

A mistake is a name and, for each lab where it can be made, the edits that make it: (file's ending,
old text, new text). A text that is not there is a fault of this file. CALLED has what `check` may
call it, where that is another name.
"""
import os

NAMES = {
    1: "lab01_diffuse",
    2: "lab02_ambient",
    3: "lab03_normal_matrix",
    4: "lab04_point_light",
    5: "lab05_per_fragment",
    6: "lab06_phong",
    7: "lab07_blinn_phong",
    8: "lab08_spot",
    9: "lab09_two_sided",
    10: "lab10_budget",
}
SOLUTIONS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "solutions")
SHADERS = (1, 2, 4, 5, 6, 7, 8, 9, 10)  # the labs whose shaders are the student's
FRAGMENTS = (5, 6, 7, 8, 9, 10)  # those lit at the fragments

# Texts of the solutions.
NORMAL = "vec3(u_NormalMatrix * vec4(a_Normal.xyz, 0.0))"
MODEL = "uniform mat4 u_NormalMatrix;"
MAIN = "void main() {\n"
TO_LIGHT = {
    4: "normalize(u_LightPosition[i] - position)",
    5: "normalize(u_LightPosition[i] - v_Position)",
    6: "normalize(u_LightPosition[i] - v_Position)",
    7: "normalize(u_LightPosition[i] - v_Position)",
    8: "toLight / distance",
    9: "normalize(u_LightPosition - v_Position)",
    10: "normalize(u_LightPosition - v_Position)",
}
COSINE = {
    1: "max(dot(u_LightDirection, normal), 0.0)",
    2: "max(dot(u_LightDirection[i], normal), 0.0)",
    4: "max(dot(lightDirection, normal), 0.0)",
    5: "max(dot(lightDirection, normal), 0.0)",
    9: "max(dot(normal, lightDirection), 0.0)",
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
}
ATTENUATION = """1.0 / (u_Attenuation.x + u_Attenuation.y * distance +
                                   u_Attenuation.z * distance * distance)"""
PROJECT = "gl_Position = u_MvpMatrix * a_Position;"
HIGHP = "precision highp float;"


def light_file(lab):
    """The file in which the light is computed."""
    return "frag" if lab in FRAGMENTS else "vert"


def each(labs, edits):
    """The same edits for several labs; `edits` may be a function of the lab."""
    return {lab: edits(lab) if callable(edits) else edits for lab in labs}


def position_edit(lab, new):
    return [("vert", "vec3(u_ModelMatrix * a_Position)", new)]


def to_light_reversed(lab):
    if lab in (1, 2):
        index = "[i]" if lab == 2 else ""
        return [
            (
                "vert",
                f"dot(u_LightDirection{index}, normal)",
                f"dot(-u_LightDirection{index}, normal)",
            )
        ]
    old = TO_LIGHT[lab]
    inner = old[len("normalize(") : -1].split(" - ")
    return [(light_file(lab), old, f"normalize({inner[1]} - {inner[0]})")]


def at_center(lab):
    """From the object's centre, not from the point."""
    start = TO_LIGHT[lab].split(" - ")[0]
    new = start + " - vec3(u_ModelMatrix * vec4(0.0, 0.0, 0.0, 1.0)))"
    edits = [(light_file(lab), TO_LIGHT[lab], new)]
    if lab in FRAGMENTS:
        declared = "uniform mat4 u_ModelMatrix;\nuniform vec3 u_LightColor"
        edits.append(("frag", "uniform vec3 u_LightColor", declared))
    return edits


def color_twice(lab):
    color = "a_Color.rgb" if lab in (1, 2, 4) else "color.rgb" if lab == 9 else "v_Color.rgb"
    if lab == 1:
        return [("vert", f"u_LightColor * {color}", f"u_LightColor * {color} * {color}")]
    if lab in (2, 4, 5, 9):
        return [(light_file(lab), OUT[lab], OUT[lab].replace(color, f"{color} * {color}"))]
    return [("vert", "v_Color = a_Color;", "v_Color = a_Color * a_Color;")]


def light_color_ignored(lab):
    if lab == 8:
        return [("frag", "spot * u_LightColor *", "spot *")]
    if lab in (9, 10):
        return [("frag", "u_LightColor * ", "")]
    index = "" if lab == 1 else "[i]"
    old = f"u_LightColor{index} * "
    if lab in (6, 7):
        return [("frag", old + "v_Color", "v_Color"), ("frag", old + "u_Specular", "u_Specular")]
    file = light_file(lab)
    if lab == 1:
        return [(file, "u_LightColor * a_Color", "a_Color")]
    return [(file, f"light += u_LightColor[i] * nDotL", "light += vec3(nDotL)")]


def gamma(lab):
    out = OUT[lab]
    inner = out[out.index("vec4(") + 5 : out.rindex(", ")]
    return [(light_file(lab), out, out.replace(inner, f"pow(max({inner}, 0.0), vec3(1.0 / 2.2))"))]


def view_edit(new):
    return each((6, 7, 8, 10), lambda lab: [("frag", VIEW, new)])


def no_test_of_cosine(lab):
    """The highlight without N.L > 0; the diffuse light keeps its clamp."""
    if lab in (6, 7):
        return [
            (
                "frag",
                LIT,
                "        {\n"
                "            color += u_LightColor[i] * v_Color.rgb * max(nDotL, 0.0);\n",
            )
        ]
    if lab == 8:
        return [
            ("frag", "if (nDotL > 0.0 && cosine", "if (cosine"),
            ("frag", "* nDotL +", "* max(nDotL, 0.0) +"),
        ]
    return [
        ("frag", "if (nDotL > 0.0) {", "{"),
        ("frag", "v_Color.rgb * nDotL", "v_Color.rgb * max(nDotL, 0.0)"),
    ]


def no_clamp(lab):
    if lab in (6, 7):
        return [
            (
                "frag",
                LIT,
                "        color += u_LightColor[i] * v_Color.rgb * nDotL;\n"
                "        if (nDotL > 0.0) {\n",
            )
        ]
    return [(light_file(lab), COSINE[lab], COSINE[lab][4:-6])]


def ambient_per_light(lab):
    file = light_file(lab)
    if lab in (6, 7):
        return [
            (file, "vec3 color = u_AmbientLight * v_Color.rgb;", "vec3 color = vec3(0.0);"),
            (
                file,
                "        float nDotL = ",
                "        color += u_AmbientLight * v_Color.rgb;\n        float nDotL = ",
            ),
        ]
    return [
        (file, "vec3 light = u_AmbientLight;", "vec3 light = vec3(0.0);"),
        (
            file,
            "light += u_LightColor[i] * nDotL",
            "light += u_AmbientLight + u_LightColor[i] * nDotL",
        ),
    ]


def ambient_times_cosine(lab):
    file = light_file(lab)
    if lab == 9:
        return [
            (
                file,
                "u_AmbientLight + u_LightColor * nDotL",
                "(u_AmbientLight + u_LightColor) * nDotL",
            )
        ]
    if lab == 10:
        return [
            (
                file,
                "vec3 color = u_AmbientLight * v_Color.rgb;",
                "vec3 color = u_AmbientLight * v_Color.rgb * max(nDotL, 0.0);",
            )
        ]
    return [
        (file, "vec3 light = u_AmbientLight;", "vec3 light = vec3(0.0);"),
        (
            file,
            "light += u_LightColor[i] * nDotL",
            "light += (u_AmbientLight + u_LightColor[i]) * nDotL",
        ),
    ]


def no_ambient(lab):
    if lab in (2, 4, 5):
        return [(light_file(lab), "vec3 light = u_AmbientLight;", "vec3 light = vec3(0.0);")]
    if lab == 9:
        return [("frag", "u_AmbientLight + u_LightColor", "u_LightColor")]
    return [("frag", "vec3 color = u_AmbientLight * v_Color.rgb;", "vec3 color = vec3(0.0);")]


def specular_edit(old, new, labs):
    return each(labs, lambda lab: [("frag", old, new)])


def gouraud(lab):
    """All of the light at the vertices."""
    text = read(lab)
    name = f"lab{lab:02}"
    vert, frag = text[name + ".vert"], text[name + ".frag"]
    body = frag[frag.index(MAIN) + len(MAIN) :]
    body = body.replace("normalize(v_Normal)", f"normalize({NORMAL})").replace(
        "v_Position", "position"
    )
    body = body.replace("v_Color", "a_Color").replace("gl_FragColor", "v_Color")
    uniforms = "".join(line + "\n" for line in frag.splitlines() if line.startswith("uniform"))
    head = vert[: vert.index("varying")]
    start = f"    {PROJECT}\n    vec3 position = vec3(u_ModelMatrix * a_Position);\n"
    return [
        ("vert", None, head + uniforms + "\nvarying vec4 v_Color;\n\n" + MAIN + start + body),
        (
            "frag",
            None,
            "precision highp float;\nvarying vec4 v_Color;\n"
            "void main() {\n    gl_FragColor = v_Color;\n}\n",
        ),
    ]


def read(lab):
    folder = os.path.join(SOLUTIONS, NAMES[lab])
    texts = {}
    for name in sorted(os.listdir(folder)):
        with open(os.path.join(folder, name)) as file:
            texts[name] = file.read()
    return texts


ROTATE = "mat4_rotate(DEGREES_PER_SECOND * seconds, AXIS, &rotation);"
PRODUCT = "mat4_product(mat4_translate(PLACE), mat4_product(rotation, mat4_scale(SCALE)))"
WORLD_AND_EYE = MODEL + "\nuniform mat4 u_EyeNormalMatrix;"

# The requirement's mistakes, and those that stand beside them in the measured list.
MISTAKES = {
    "light direction reversed": each((1, 2, 4, 5, 6, 7, 9, 10), to_light_reversed),
    "light direction not normalized": each(
        (4, 5, 6, 7, 9, 10), lambda lab: [(light_file(lab), TO_LIGHT[lab], TO_LIGHT[lab][9:])]
    ),
    "normal not normalized": {
        4: [("vert", f"normalize({NORMAL})", NORMAL)],
        9: [("vert", f"normalize({NORMAL})", NORMAL), ("frag", "normalize(v_Normal)", "v_Normal")],
    },
    "not renormalized per fragment": each(
        (5, 6, 7, 8), [("frag", "normalize(v_Normal)", "v_Normal")]
    ),
    "model matrix for normals": {
        3: [("c", "mat4_transpose(inverse)", "*world_from_model")],
        **each((4, 5, 6, 7, 8, 9), [("vert", "u_NormalMatrix *", "u_ModelMatrix *")]),
    },
    "inverse without transpose": {
        3: [("c", "mat4_transpose(inverse)", "inverse")],
        **each(
            (1, 2, 4, 5, 6, 7, 8, 9),
            [
                (
                    "vert",
                    "u_NormalMatrix * vec4(a_Normal.xyz, 0.0)",
                    "vec4(a_Normal.xyz, 0.0) * u_NormalMatrix",
                )
            ],
        ),
    },
    "transposed twice": {
        3: [("c", "mat4_transpose(inverse)", "mat4_transpose(mat4_transpose(inverse))")]
    },
    "normals not transformed": {
        3: [("c", "mat4_transpose(inverse)", "mat4_identity()")],
        **each((1, 2, 4, 5, 6, 7, 8, 9), [("vert", NORMAL, "a_Normal.xyz")]),
    },
    "clamp missing": each((2, 4, 5, 6, 7, 9), no_clamp),
    "highlight on the dark side": each((6, 7, 8, 10), no_test_of_cosine),
    "reflect's sign": {
        6: [("frag", "reflect(-lightDirection", "reflect(lightDirection")],
        8: [("frag", "reflect(-lightDirection", "reflect(lightDirection")],
        10: [
            (
                "frag",
                "2.0 * nDotL * normal - lightDirection",
                "lightDirection - 2.0 * nDotL * normal",
            )
        ],
    },
    "view vector of eye space": view_edit("normalize(-v_Position)"),
    "view vector fixed": view_edit("vec3(0.0, 0.0, 1.0)"),
    "normal in eye space": each(
        (1, 2, 4, 5, 6, 7, 8, 9),
        [("vert", MODEL, WORLD_AND_EYE), ("vert", "u_NormalMatrix *", "u_EyeNormalMatrix *")],
    ),
    "position in eye space": each(
        (4, 5, 6, 7, 8, 9, 10),
        [
            (
                "vert",
                "uniform mat4 u_ModelMatrix;",
                "uniform mat4 u_ModelMatrix;\nuniform mat4 u_ModelViewMatrix;",
            ),
            ("vert", "vec3(u_ModelMatrix * a_Position)", "vec3(u_ModelViewMatrix * a_Position)"),
        ],
    ),
    "w = 1 for a direction": {
        **each(
            (1, 2),
            [
                ("vert", MODEL, "uniform mat4 u_ModelMatrix;"),
                ("vert", NORMAL, "vec3(u_ModelMatrix * a_Normal)"),
            ],
        ),
        **each((4, 5, 6, 7, 8, 9), [("vert", NORMAL, "vec3(u_ModelMatrix * a_Normal)")]),
    },
    "w = 0 for a point": each(
        (4, 5, 6, 7, 8, 9),
        lambda lab: position_edit(lab, "vec3(u_ModelMatrix * vec4(a_Position.xyz, 0.0))"),
    ),
    "light from the object's centre": each((4, 5, 6, 7, 9, 10), at_center),
    "degrees for radians": {
        3: [("c", ROTATE, ROTATE.replace("* seconds", "* seconds * 3.14159265 / 180"))],
        8: [("frag", "cos(radians(u_SpotCutoff))", "cos(u_SpotCutoff)")],
    },
    "rows for columns": {
        3: [
            (
                "c",
                "    Mat4 inverse;",
                "    *world_from_model = mat4_transpose(*world_from_model);\n    Mat4 inverse;",
            )
        ],
        **each(SHADERS, [("vert", "u_MvpMatrix * a_Position", "a_Position * u_MvpMatrix")]),
    },
    "ambient for each light": each((2, 4, 5, 6, 7), ambient_per_light),
    "ambient times the cosine": each((2, 4, 5, 9, 10), ambient_times_cosine),
    "ambient missing": each((2, 4, 5, 6, 7, 8, 9, 10), no_ambient),
    "colour used twice": each(SHADERS, color_twice),
    "light colour ignored": each(SHADERS, light_color_ignored),
    "attenuation by the square": {
        8: [
            (
                "frag",
                "    float cosine = ",
                "    float square = distance * distance;\n    float cosine = ",
            ),
            ("frag", "u_Attenuation.y * distance +", "u_Attenuation.y * square +"),
            ("frag", "u_Attenuation.z * distance * distance", "u_Attenuation.z * square * square"),
        ]
    },
    "attenuation by the inverse square": {
        8: [("frag", ATTENUATION, "1.0 / (distance * distance)")]
    },
    "attenuation inverted": {8: [("frag", "1.0 / (u_Attenuation.x", "(u_Attenuation.x")]},
    "attenuation missing": {8: [("frag", "attenuation * spot", "spot")]},
    "spot: angle for cosine": {
        8: [("frag", "cosine >= cos(radians(u_SpotCutoff))", "cosine >= radians(u_SpotCutoff)")]
    },
    "spot: hard edge": {8: [("frag", "attenuation * spot", "attenuation")]},
    "spot: no cutoff": {8: [("frag", " && cosine >= cos(radians(u_SpotCutoff))", "")]},
    "winding": each(
        (1, 2, 4, 5, 6, 7, 8, 10),
        lambda lab: [("frag", MAIN, MAIN + "    if (gl_FrontFacing) discard;\n")],
    ),
    "depth reversed": each(
        (1, 2, 4, 5, 6, 7, 8, 9),
        [("vert", PROJECT, PROJECT + "\n    gl_Position.z = -gl_Position.z;")],
    ),
    "no depth": each(
        (1, 2, 4, 5, 6, 7, 8, 9), [("vert", PROJECT, PROJECT + "\n    gl_Position.z = 0.0;")]
    ),
    "upside-down": each(
        (1, 2, 4, 5, 6, 7, 8, 10),
        [("vert", PROJECT, PROJECT + "\n    gl_Position.y = -gl_Position.y;")],
    ),
    "aspect ratio ignored": each(
        SHADERS,
        [
            (
                "vert",
                "uniform mat4 u_MvpMatrix;",
                "uniform mat4 u_MvpMatrix;\nuniform mat4 u_ProjMatrix;\n"
                "uniform mat4 u_ModelViewMatrix;",
            ),
            (
                "vert",
                PROJECT,
                "mat4 projection = u_ProjMatrix;\n    projection[0][0] = projection[1][1];\n"
                "    gl_Position = projection * u_ModelViewMatrix * a_Position;",
            ),
        ],
    ),
    "mediump overflow": each((5, 6, 7, 8, 9), [("frag", HIGHP, "precision mediump float;")]),
    "pow of a negative number": {
        **specular_edit(
            "max(dot(reflected, viewDirection), 0.0)", "dot(reflected, viewDirection)", (6, 8)
        ),
        10: [
            (
                "frag",
                "max(dot(2.0 * nDotL * normal - lightDirection, viewDirection), 0.0)",
                "dot(2.0 * nDotL * normal - lightDirection, viewDirection)",
            )
        ],
    },
    "half vector not normalized": specular_edit(
        "normalize(lightDirection + viewDirection)", "(lightDirection + viewDirection) / 2.0", (7,)
    ),
    "shininess not fitted": specular_edit("4.0 * u_Shininess + 1.3", "u_Shininess", (7,)),
    "Phong for Blinn-Phong": {
        7: [
            (
                "frag",
                "vec3 halfway = normalize(lightDirection + viewDirection);",
                "vec3 reflected = reflect(-lightDirection, normal);",
            ),
            ("frag", "max(dot(normal, halfway), 0.0)", "max(dot(reflected, viewDirection), 0.0)"),
            ("frag", "pow(nDotH, shininess)", "pow(nDotH, u_Shininess)"),
        ]
    },
    "Blinn-Phong for Phong": each(
        (6, 8),
        [
            (
                "frag",
                "vec3 reflected = reflect(-lightDirection, normal);",
                "vec3 halfway = normalize(lightDirection + viewDirection);",
            ),
            ("frag", "max(dot(reflected, viewDirection), 0.0)", "max(dot(normal, halfway), 0.0)"),
        ],
    ),
    "highlight tinted by the object": {
        **specular_edit(
            "u_LightColor[i] * u_SpecularColor *",
            "u_LightColor[i] * u_SpecularColor * v_Color.rgb *",
            (6, 7),
        ),
        **specular_edit("u_SpecularColor * pow", "u_SpecularColor * v_Color.rgb * pow", (8, 10)),
    },
    "highlight missing": {
        **specular_edit(
            "u_LightColor[i] * u_SpecularColor *",
            "0.0 * u_LightColor[i] * u_SpecularColor *",
            (6, 7),
        ),
        **specular_edit("u_SpecularColor * pow", "0.0 * u_SpecularColor * pow", (8, 10)),
    },
    "light at the vertices": each((5, 6, 7, 8), gouraud),
    "second light missing": each(
        (2, 4, 5, 6, 7), lambda lab: [(light_file(lab), "i < 2", "i < 1")]
    ),
    "gamma": each(SHADERS, gamma),
    "facing without the mirror": {
        9: [("frag", "gl_FrontFacing == (u_Mirrored > 0.0)", "gl_FrontFacing")]
    },
    "the back's normal not reversed": {9: [("frag", "        normal = -normal;\n", "")]},
    "the back's colour missing": {9: [("frag", "        color = u_BackColor;\n", "")]},
    "sides exchanged": {9: [("frag", "if (!front)", "if (front)")]},
    "turned the wrong way": {
        3: [("c", ROTATE, ROTATE + "\n    rotation = mat4_transpose(rotation);")]
    },
    "moved before turned": {
        3: [
            (
                "c",
                PRODUCT,
                "mat4_product(rotation, mat4_product(mat4_translate(PLACE), mat4_scale(SCALE)))",
            )
        ]
    },
    "scaled after turned": {
        3: [
            (
                "c",
                PRODUCT,
                "mat4_product(mat4_translate(PLACE), mat4_product(mat4_scale(SCALE), rotation))",
            )
        ]
    },
    "product in the reverse order": {
        3: [
            (
                "c",
                PRODUCT,
                "mat4_product(mat4_scale(SCALE), mat4_product(rotation, mat4_translate(PLACE)))",
            )
        ]
    },
    "not turned": {3: [("c", "DEGREES_PER_SECOND = 30", "DEGREES_PER_SECOND = 0")]},
    "not moved": {3: [("c", "PLACE = {0.5, 0.3, -0.8}", "PLACE = {0, 0, 0}")]},
    "not scaled": {3: [("c", "SCALE = {2, 0.7, 1.2}", "SCALE = {1, 1, 1}")]},
    "moved the wrong way": {3: [("c", "PLACE = {0.5, 0.3, -0.8}", "PLACE = {-0.5, -0.3, 0.8}")]},
    "scaled inversely": {3: [("c", "SCALE = {2, 0.7, 1.2}", "SCALE = {0.5, 1 / 0.7, 1 / 1.2}")]},
    "turned about another axis": {3: [("c", "AXIS = {1, 2, 0.5}", "AXIS = {0, 1, 0}")]},
    "inverse of the model matrix": {
        3: [
            (
                "c",
                "    Mat4 inverse;",
                "    Mat4 world = *world_from_model;\n"
                "    mat4_inverse(world, world_from_model);\n    Mat4 inverse;",
            )
        ]
    },
}

# The same at once: two of these, where both can be made in one text. What hides the other is left
# out: `pairs` makes them, and whoever checks decides by the pictures.
ALONE = {"light at the vertices"}  # the whole text is another

# Two that make the very program of a third, whose name is then right.
THIRD = {
    ("light direction reversed", "reflect's sign"): "normal reversed",
    ("the back's normal not reversed", "the back's colour missing"): "back not lit",
}


# What `check` may call them: its own names, and several where the pictures are the same.
CALLED = {
    "normal not normalized": {"normal not made unit"},
    "transposed twice": {"inverse without transpose"},
    "clamp missing": {"missing clamp"},
    "highlight on the dark side": {"specular on the dark side"},
    "view vector of eye space": {"view vector from the wrong space"},
    "view vector fixed": {"fixed view vector"},
    "normal in eye space": {"world and eye space mixed"},
    "position in eye space": {"world and eye space mixed"},
    # In lab 10 the centre is the world's origin.
    "light from the object's centre": {
        "light direction from the object's centre",
        "point light taken for a directional one",
    },
    "rows for columns": {
        "rows for columns in the position",
        "rows for columns in the model matrix",
    },
    "ambient for each light": {"ambient added per light"},
    "ambient times the cosine": {"ambient multiplied by the cosine"},
    "spot: angle for cosine": {"angle compared with a cosine"},
    "spot: hard edge": {"no soft edge"},
    "spot: no cutoff": {"no cutoff"},
    "winding": {"inside seen"},
    "no depth": {"no depth test"},
    "upside-down": {"upside down"},
    "Phong for Blinn-Phong": {"the other reflection model"},
    "Blinn-Phong for Phong": {"the other reflection model"},
    "highlight tinted by the object": {"highlight in the object's colour"},
    "highlight missing": {"no highlight"},
    "second light missing": {"only the first light"},
    "gamma": {"extra gamma"},
    "facing without the mirror": {"gl_FrontFacing in a mirror"},
    "the back's normal not reversed": {"back's normal not reversed"},
    "the back's colour missing": {"back in the front's colour"},
    "sides exchanged": {"front and back swapped"},
    "moved before turned": {"moved before it is turned"},
    "scaled after turned": {"turned before it is scaled"},
}


def applied(texts, lab, edits):
    """The texts with these edits made; None where a text to replace is not there (any more)."""
    texts = dict(texts)
    for ending, old, new in edits:
        name = next(n for n in texts if n.endswith("." + ending))
        if old is None:
            texts[name] = new
        elif old not in texts[name]:
            return None
        else:
            texts[name] = texts[name].replace(old, new)
    return texts


def as_the_lecture(texts):
    """Without unit normals at the vertices of what is lit at the fragments: as right."""
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
    """Both mistakes in one text, or None where they touch the same place."""
    if {first, second} & ALONE:
        return None
    one = applied(read(lab), lab, MISTAKES[first][lab])
    both = one and applied(one, lab, MISTAKES[second][lab])
    swapped = applied(read(lab), lab, MISTAKES[second][lab])
    swapped = swapped and applied(swapped, lab, MISTAKES[first][lab])
    if not both or both != swapped:
        return None
    return as_the_lecture(both) if lecture else both


# What is wrong and matches no mistake: what is drawn in the place of the solution's last line. A
# mistake named here is a false accusation.
NOISE = "fract(sin(dot(gl_FragCoord.xy, vec2(12.9898, 78.233))) * 43758.5453)"
ART = {
    "grey": (5, "gl_FragColor = vec4(0.5, 0.5, 0.5, 1.0);"),
    "red": (6, "gl_FragColor = vec4(0.9, 0.1, 0.0, 1.0);"),
    "white": (7, "gl_FragColor = vec4(1.0);"),
    "normal as colour": (5, "gl_FragColor = vec4(normal * 0.5 + 0.5, 1.0);"),
    "place as colour": (6, "gl_FragColor = vec4(fract(v_Position), 1.0);"),
    "chequers": (
        7,
        "vec2 square = floor(gl_FragCoord.xy / 8.0);\n"
        "    gl_FragColor = vec4(vec3(mod(square.x + square.y, 2.0)), 1.0);",
    ),
    "stripes": (
        5,
        "gl_FragColor = vec4(light * v_Color.rgb * (0.5 + 0.5 * sin(20.0 * v_Position.y)), 1.0);",
    ),
    "noise": (
        6,
        f"gl_FragColor = vec4(vec3({NOISE}), 1.0);",
    ),
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
    "squared": (
        9,
        "gl_FragColor = vec4((u_AmbientLight + u_LightColor * nDotL * nDotL) * color.rgb, 1.0);",
    ),
    "negative": (6, "gl_FragColor = vec4(1.0 - color, 1.0);"),
    "channels exchanged": (7, "gl_FragColor = vec4(color.bgr, 1.0);"),
    "half as bright": (8, "gl_FragColor = vec4(0.5 * color, 1.0);"),
    "a tenth darker": (5, "gl_FragColor = vec4(0.9 * light * v_Color.rgb, 1.0);"),
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
    "black and white": (1, "v_Color = vec4(vec3(dot(diffuse, vec3(0.3, 0.6, 0.1))), 1.0);"),
    "every face another colour": (2, "v_Color = vec4(abs(a_Normal.xyz), 1.0);"),
}


def art(name):
    lab, text = ART[name]
    return lab, applied(read(lab), lab, [(light_file(lab), OUT[lab], text)])
