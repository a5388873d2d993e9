// lighting.vert: the whole lighting model; common/lighting/lighting_program.c selects by defines
// what the effects of an object need, and generates the groups of lights.
//
// Lighting is in eye coordinates: the eye at the origin, looking along -z.

attribute vec4 a_Position;
uniform mat4 u_ClipFromObject;

#ifdef VERTEX_COLOR
attribute vec3 a_Color;
#ifdef FRAGMENT_COLOR
varying vec3 v_Color;
#endif
#endif
#ifdef LIT_POSITION
attribute vec3 a_LitPosition; // of the triangle's last vertex
#define LIT_POSITION_OBJECT vec4(a_LitPosition, 1.0)
#else
#define LIT_POSITION_OBJECT a_Position
#endif

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
#include "lighting/base.glsl"
#endif

#endif
#if defined(VERTEX_LIGHTS) || defined(SHADOW_MAPS)
#include "lighting/vertex_groups.glsl"
#endif

#ifdef MASK_PLACE
varying vec3 v_MaskPlace;
#endif

void main() {
    gl_Position = u_ClipFromObject * a_Position;
#ifdef MASK_PLACE
    v_MaskPlace = gl_Position.xyw;
#endif

#ifdef VERTEX_COLOR
    surface_color = a_Color;
#ifdef FRAGMENT_COLOR
    v_Color = a_Color;
#endif
#endif
#ifdef SHADOW_MAPS
    place_on_maps();
#endif
    vec3 position = vec3(0.0);
    vec3 normal = vec3(0.0);
#ifdef POSITION
    position = vec3(u_EyeFromObject * LIT_POSITION_OBJECT);
#endif
#ifdef NORMALS
#ifdef NORMAL_MATRIX
    normal = vec3(u_NormalMatrix * vec4(a_Normal, 0.0));
#else
    normal = vec3(u_EyeFromObject * vec4(a_Normal, 0.0));
#endif
#ifdef NORMALIZE_VERTEX
    normal = safe_normalize(normal);
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
    v_FrontColor = FRONT_BASE;
#endif
    add_lights(normal, position, viewer, true, v_FrontColor);
#ifdef CLAMP_VERTEX
    v_FrontColor = clamp(v_FrontColor, 0.0, 1.0);
#endif
#ifdef TWO_SIDED
    v_BackColor = vec3(0.0);
#ifdef BASE
    v_BackColor = BACK_BASE;
#endif
    add_lights(BACK(normal), position, viewer, false, v_BackColor);
#ifdef CLAMP_VERTEX
    v_BackColor = clamp(v_BackColor, 0.0, 1.0);
#endif
#endif
#endif
}
