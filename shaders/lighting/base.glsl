// base.glsl: emission and constant ambient light.

uniform vec3 u_FrontBase;
#ifdef TWO_SIDED
uniform vec3 u_BackBase;
#endif

#ifdef VERTEX_COLOR
uniform vec3 u_FrontTint; // ambient light, which the color of the surface reflects
#ifdef TWO_SIDED
uniform vec3 u_BackTint;
#endif
#define FRONT_BASE (u_FrontBase + u_FrontTint * surface_color)
#define BACK_BASE (u_BackBase + u_BackTint * surface_color)
#else
#define FRONT_BASE u_FrontBase
#define BACK_BASE u_BackBase
#endif
