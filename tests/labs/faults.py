"""Texts that do not compile, as edits of the solutions, and what `check` has to say of them.

A fault is the lab and its texts, the ending of the file that the message names with a line (None:
no line is known), and what the explanation says.
"""
from mistakes import applied, frag, read, vert


def fault(lab, edits, file, meaning):
    return (lab, applied(read(lab), lab, edits)), file, meaning


LIGHT = "vec3 light = u_AmbientLight;"
NORMAL = "normalize(v_Normal)"
BEFORE = "    vec3 normal"  # the first statement of lab 1

FAULTS = {
    "no semicolon": fault(5, frag(LIGHT, LIGHT[:-1]), "frag", r"semicolon"),
    "whole number times vector": fault(
        1, vert("vec3 diffuse = ", "vec3 diffuse = 2 * "), "vert", r"2\.0"
    ),
    "whole number in max": fault(5, frag(", 0.0);", ", 0);"), "frag", r"0\.0"),
    "whole number for a float": fault(
        6,
        frag(
            "float nDotL = dot(normal, lightDirection);",
            "float nDotL = dot(normal, lightDirection); float k = 1;",
        ),
        "frag",
        r"1\.0",
    ),
    "name not declared": fault(
        5, frag("nDotL = max", "nDotl = max"), "frag", r"nDotL is not declared: did you mean nDotl[?]"
    ),
    "uniform not declared": fault(
        5, frag("uniform vec3 u_AmbientLight;\n", ""), "frag", r"declared"
    ),
    "misspelled function": fault(
        5, frag(NORMAL, "normalise(v_Normal)"), "frag", r"no function normalise: did you mean normalize[?]"
    ),
    "wrong vec constructor": fault(
        5,
        frag("vec4(light * v_Color.rgb, v_Color.a)", "vec4(light * v_Color.rgb)"),
        "frag",
        r"needs 4 numbers, not 3",
    ),
    "vec4 into vec3": fault(
        5,
        vert(
            "v_Position = vec3(u_ModelMatrix * a_Position);",
            "v_Position = u_ModelMatrix * a_Position;",
        ),
        "vert",
        r"\.xyz",
    ),
    "vec3 plus vec4": fault(
        5, frag("light * v_Color.rgb", "light * v_Color"), "frag", r"\.rgb|\.xyz"
    ),
    "matrix times vec3": fault(
        5, vert("vec4(a_Normal.xyz, 0.0)", "a_Normal.xyz"), "vert", r"vec4\("
    ),
    "precision missing": fault(
        1, frag("precision mediump float;", ""), "frag", r"precision"
    ),
    "varying of another type": fault(
        5,
        frag("varying vec3 v_Normal;", "varying vec4 v_Normal;")
        + frag(NORMAL, "normalize(v_Normal.xyz)"),
        "(?:frag|vert)",
        r"varying|both",
    ),
    "varying of another name": fault(
        5, frag("v_Normal", "v_normal"), "frag", r"varying|vertex shader|declared"
    ),
    "assignment to a varying": fault(
        5,
        frag(f"vec3 normal = {NORMAL};", f"v_Normal = {NORMAL}; vec3 normal = v_Normal;"),
        "frag",
        r"read",
    ),
    "assignment to an attribute": fault(
        1, vert(BEFORE, f"    a_Normal = vec4(0.0);\n{BEFORE}"), "vert", r"read"
    ),
    "assignment to a uniform": fault(
        1, vert(BEFORE, f"    u_LightColor = vec3(1.0);\n{BEFORE}"), "vert", r"read"
    ),
    "no main": fault(1, frag("void main()", "void mian()"), None, r"function `void main"),
    "brace missing": fault(
        5, frag("v_Color.a);\n}\n", "v_Color.a);\n"), "frag", r"brace|\}"
    ),
    "texture": fault(
        5,
        frag("    gl_FragColor = ", "    gl_FragColor = texture(u_AmbientLight, vec2(0.0)) + "),
        "frag",
        r"write texture2D",
    ),
    "later GLSL": fault(1, vert("// Lab 1", "#version 300 es\n// Lab 1"), "vert", r"^"),
    "in and out": fault(
        1, vert("attribute", "in") + vert("varying", "out"), "vert", r"attribute|varying"
    ),
    "out in the fragment shader": fault(
        1,
        frag("varying vec4 v_Color;", "in vec4 v_Color;\nout vec4 color;"),
        "frag",
        r"varying|gl_FragColor",
    ),
    "swizzle": fault(5, frag("v_Color.a);", "v_Color.q.x.y);"), "frag", r"component"),
    "name that is not the lab's": fault(
        5, frag("u_AmbientLight", "u_AmbientLigth"), None, r"did you mean u_AmbientLight\?"
    ),
    "attribute of another type": fault(
        1,
        vert("attribute vec4 a_Normal", "attribute mat4 a_Normal")
        + vert("a_Normal.xyz", "a_Normal[0].xyz"),
        None,
        r"a_Normal.*vec4",
    ),
    "HLSL": fault(5, frag("vec3 normal", "float3 normal"), "frag", r"write vec3"),
    "C's double": fault(1, vert("float nDotL", "double nDotL"), "vert", r"."),
}
