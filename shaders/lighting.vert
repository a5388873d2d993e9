// lighting.vert: the full lighting model, of which a scene gets only what it calls for. The defines
// and the groups of lights are put together by common/lighting.c from the scene's effects.
//
// All lighting is in eye coordinates: the eye at the origin, looking along -z.

attribute vec4 a_Position;
uniform mat4 u_ClipFromObject;

#ifdef NORMALS
attribute vec3 a_Normal;
#endif
#if defined(NORMALS) && !defined(NORMAL_MATRIX) || defined(POSITION)
uniform mat4 u_EyeFromObject;
#endif
#ifdef NORMAL_MATRIX
uniform mat4 u_NormalMatrix;
#endif

#define LEAST 1e-37
#define MOST 1e37
// The fragment shader has uniforms of the same kind, perhaps of another precision.
#define u_LocalViewer u_VertexLocalViewer
#define u_BackNormal u_VertexBackNormal
#define u_FrontShininess u_VertexFrontShininess
#define u_BackShininess u_VertexBackShininess
#include "lighting/common.glsl"

#ifdef FRAGMENT_NORMALS
varying vec3 v_Normal;
#endif
#ifdef FRAGMENT_POSITION
varying vec3 v_Position;
#endif

#ifdef VERTEX_LIGHTS
varying vec3 v_FrontColor;
#ifdef TWO_SIDED
varying vec3 v_BackColor;
#endif
#ifdef BASE
uniform vec3 u_FrontBase;
#ifdef TWO_SIDED
uniform vec3 u_BackBase;
#endif
#endif

#include "lighting/vertex_groups.glsl"
#endif

void main() {
    gl_Position = u_ClipFromObject * a_Position;

    vec3 position = vec3(0.0);
    vec3 normal = vec3(0.0);
#ifdef POSITION
    position = vec3(u_EyeFromObject * a_Position);
#endif
#ifdef NORMALS
#ifdef NORMAL_MATRIX
    normal = vec3(u_NormalMatrix * vec4(a_Normal, 0.0));
#else
    normal = vec3(u_EyeFromObject * vec4(a_Normal, 0.0));
#endif
#ifdef NORMALIZE_VERTEX
#ifdef GUARD_VERTEX
    normal = safe_normalize(normal);
#else
    normal = normalize(normal);
#endif
#endif
#endif

#ifdef FRAGMENT_NORMALS
    v_Normal = normal;
#endif
#ifdef FRAGMENT_POSITION
    v_Position = position;
#endif

#ifdef VERTEX_LIGHTS
    vec3 viewer = VIEWER(position);
    v_FrontColor = vec3(0.0);
#ifdef BASE
    v_FrontColor = u_FrontBase;
#endif
    add_lights(normal, position, viewer, true, v_FrontColor);
#ifdef CLAMP_VERTEX
    v_FrontColor = clamp(v_FrontColor, 0.0, 1.0);
#endif
#ifdef TWO_SIDED
    v_BackColor = vec3(0.0);
#ifdef BASE
    v_BackColor = u_BackBase;
#endif
    add_lights(BACK(normal), position, viewer, false, v_BackColor);
#ifdef CLAMP_VERTEX
    v_BackColor = clamp(v_BackColor, 0.0, 1.0);
#endif
#endif
#endif
}
