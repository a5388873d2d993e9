// common.glsl: shared by vertex and fragment shader. Eye coordinates.

#include "lighting/guards.glsl"
#include "lighting/cone.glsl"

#ifdef VERTEX_COLOR
vec3 surface_color; // the ambient and diffuse reflectivity
#endif

// The direction to the eye, or +z if the viewer is at infinity.
#ifdef FULL
uniform float u_LocalViewer; // 0 or 1
#define VIEWER(position) safe_normalize(mix(vec3(0.0, 0.0, 1.0), -position, u_LocalViewer))
#elif defined(LOCAL_VIEWER)
#define VIEWER(position) safe_normalize(-position)
#else
#define VIEWER(position) vec3(0.0, 0.0, 1.0)
#endif

// The normal of the back side.
#ifdef FULL
uniform float u_BackNormal; // -1 with two-sided lighting, else 1
#define BACK(normal) (u_BackNormal * (normal))
#else
#define BACK(normal) (-(normal))
#endif

#ifdef SHININESS
#include "lighting/highlight.glsl"
uniform float u_FrontShininess;
#ifdef TWO_SIDED
uniform float u_BackShininess;
#endif
#endif
