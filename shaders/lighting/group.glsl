// group.glsl: lights with equal terms. Included once per group, with GROUP (the function's name),
// COUNT and the terms defined, and the uniforms renamed.
// (OpenGL 1.1 specification, section 2.13.1; the CPU multiplies colors of light and material)

#ifdef ANY
uniform vec4 u_Position[COUNT]; // w = 0: a direction
#elif defined(DIRECTIONAL)
uniform vec3 u_Direction[COUNT]; // towards the light, unit
#else
uniform vec3 u_Position[COUNT];
#endif
#ifdef AMBIENT
uniform vec3 u_FrontAmbient[COUNT];
#ifdef TWO_SIDED
uniform vec3 u_BackAmbient[COUNT];
#endif
#endif
#ifdef DIFFUSE
uniform vec3 u_FrontDiffuse[COUNT];
#ifdef TWO_SIDED
uniform vec3 u_BackDiffuse[COUNT];
#endif
#endif
#ifdef SPECULAR
uniform vec3 u_FrontSpecular[COUNT];
#ifdef TWO_SIDED
uniform vec3 u_BackSpecular[COUNT];
#endif
#endif
#ifdef HALF_VECTOR
uniform vec3 u_Half[COUNT]; // unit
#endif
#ifdef ATTENUATION
uniform vec3 u_Attenuation[COUNT]; // constant, linear, quadratic
#endif
#ifdef RANGE
uniform float u_Range[COUNT]; // 1 / its square; 0: none
#endif
#ifdef SPOT
uniform vec4 u_Spot[COUNT]; // the cone's axis, away from the light, unit; the cosine of its cutoff
#endif
#ifdef EXPONENT
uniform float u_Exponent[COUNT];
#endif
#ifdef CHANNELS
uniform vec4 u_Channel[COUNT]; // 1 in that of the light, of the mask that the group looks up
#endif
#ifdef SHADOW
#define LIT(value) (lit * (value))
#else
#define LIT(value) (value)
#endif

// From behind no light arrives; without the clamp light would be taken away.
#ifdef SIGNED_DOTS
#define ARRIVING(n_dot_l) (n_dot_l)
#else
#define ARRIVING(n_dot_l) max(n_dot_l, 0.0)
#endif

#ifdef TWO_SIDED
#define PICK(front_value, back_value) (front ? front_value : back_value)
#else
#define PICK(front_value, back_value) front_value
#endif

void GROUP(vec3 normal, vec3 position, vec3 viewer, bool front, inout vec3 color) {
    for (int i = 0; i < COUNT; i++) {
        float share = 1.0; // the attenuation
#ifdef DIRECTIONAL
        vec3 to_light = u_Direction[i];
#else
#ifdef ANY
        vec3 way = u_Position[i].xyz - u_Position[i].w * position;
#else
        vec3 way = u_Position[i] - position;
#endif
        float square = dot(way, way);
        vec3 to_light = way * safe_inversesqrt(square);
#ifdef ATTENUATION
#ifdef GUARD_ATTENUATION
        float held = min(square, MOST); // 0 times infinity is NaN
        share = safe_inverse(dot(u_Attenuation[i], vec3(1.0, sqrt(held), held)));
#else
        share = 1.0 / dot(u_Attenuation[i], vec3(1.0, sqrt(square), square));
#endif
#endif
#endif
#ifdef RANGE
        float near = min(square * u_Range[i], 2.0);
        share *= max(1.0 - near * near, 0.0); // KHR_lights_punctual
#endif
#ifdef SPOT
        float along = dot(-to_light, u_Spot[i].xyz);
#ifdef ANY
        share *= in_cone(along, u_Spot[i].w) ? safe_pow(along, u_Exponent[i]) : 0.0;
#elif defined(EXPONENT)
        // Within the cone the cosine is more than 0, for no cutoff exceeds 90 degrees.
        share *= in_cone(along, u_Spot[i].w) ? pow(along, u_Exponent[i]) : 0.0;
#else
        share *= in_cone(along, u_Spot[i].w) ? 1.0 : 0.0;
#endif
#endif

        vec3 sum = vec3(0.0);
#ifdef AMBIENT
        sum += PICK(u_FrontAmbient[i], u_BackAmbient[i]);
#ifdef VERTEX_SHADOW // which does not fall on ambient light
#ifdef VERTEX_COLOR
        sum *= surface_color;
#endif
        color += share * sum;
        sum = vec3(0.0);
#endif
#endif
#if defined(DIFFUSE) || defined(SPECULAR)
        float n_dot_l = dot(normal, to_light);
#endif
#ifdef SHADOW
        float lit = 1.0 - SHADOWED;
#endif
#ifdef DIFFUSE
        sum += PICK(u_FrontDiffuse[i], u_BackDiffuse[i]) * LIT(ARRIVING(n_dot_l));
#endif
#if defined(VERTEX_COLOR) && defined(AMBIENT) || defined(VERTEX_COLOR) && defined(DIFFUSE)
        sum *= surface_color;
#endif
#ifdef SPECULAR
        float shininess = PICK(u_FrontShininess, u_BackShininess);
#ifdef PHONG
        float power = highlight(2.0 * n_dot_l * normal - to_light, viewer, shininess);
#elif defined(HALF_VECTOR)
        float power = highlight(normal, u_Half[i], shininess);
#else
        float power = highlight(normal, safe_normalize(to_light + viewer), shininess);
#endif
        sum += PICK(u_FrontSpecular[i], u_BackSpecular[i]) * LIT(facing(n_dot_l, power));
#endif
#ifdef VERTEX_SHADOW // looked up at the fragments
        if (front)
            v_FrontDirect[VERTEX_SHADOW + i] = share * sum;
#ifdef TWO_SIDED
        else
            v_BackDirect[VERTEX_SHADOW + i] = share * sum;
#endif
#else
        color += share * sum;
#endif
    }
}

#undef PICK
#undef LIT
#undef ARRIVING
