// shadow.vert: the depths of surfaces, and the volumes that they keep from a light. Both in one
// program, so that equal vertices land at equal depths. With DRAW_MAP: the
// depths of a shadow map; with LOOK_UP: the surfaces again, to compare with one.

attribute vec4 a_Position; // w = 0: moved to the end, away from the light
uniform mat4 u_ClipFromObject;
#ifndef DRAW_MAP
uniform float u_Near;
#endif

invariant gl_Position;

#ifdef DRAW_MAP
#ifdef PACKED
varying highp vec2 v_Depth;
#endif
#elif defined(LOOK_UP)
attribute vec3 a_Normal;
uniform mat4 u_LightFromObject; // the light looks along -z
uniform mat4 u_LightNormal;
varying highp vec3 v_MapPlace;
varying highp vec3 v_MapNormal;
#else
uniform vec3 u_Center; // in object coordinates, near the vertices
uniform vec4 u_Light;  // from there; w = 0: the direction towards it
uniform vec4 u_End;    // a plane, from there; (0, 0, 0, 1) is infinity
#endif

void main() {
    vec4 place = a_Position;
#if !defined(DRAW_MAP) && !defined(LOOK_UP)
    if (place.w == 0.0) {
        // Where the line from the light meets the plane. (Blinn, Me and my (fake) shadow, IEEE CG&A
        // 8(1), 1988)
        vec4 from = vec4(place.xyz - u_Center, 1.0);
        place = dot(u_End, u_Light) * from - dot(u_End, from) * u_Light;
        place.xyz += place.w * u_Center;
    }
#endif
    gl_Position = u_ClipFromObject * place;
#ifdef DRAW_MAP
#ifdef PACKED
    v_Depth = gl_Position.zw;
#endif
#else
    // Of a projection without a far plane. At infinity z is w, bit by bit, and stays so where a
    // face is cut at the picture's sides: one that fills nearly half of all directions, because the
    // light is close before it, is cut where most of z and w cancel, and is not to be beyond the
    // far plane by what is left of their roundings. (Everitt and Kilgard, Practical and Robust
    // Stenciled Shadow Volumes, 2002)
    gl_Position.z = gl_Position.w - 2.0 * u_Near * place.w;
#endif
#ifdef LOOK_UP
    v_MapPlace = (u_LightFromObject * place).xyz;
    v_MapNormal = (u_LightNormal * vec4(a_Normal, 0.0)).xyz;
#endif
}
