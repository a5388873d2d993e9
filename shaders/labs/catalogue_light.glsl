// Light on a point, with or without mistakes. The numbers of the modes are those of
// examples/labs/diagnosis/catalogue.h.

uniform int u_AtVertices;
// Normals are normalized: 0: where light is computed; 1: nowhere; 2: at the vertices; 3: at both; 4:
// where light is computed, with w = 1.
uniform int u_NormalUnit;
uniform vec3 u_Light[2];   // positions or directions
uniform float u_FromPlace; // 1: the direction to the light starts at the point
uniform int u_LightUnit;   // 0: normalized; 1: not; 2: only at the vertices
uniform float u_LightSign;
// 0: clamped; 1: not; 2: absolute; 3: none; 4: wrapped; 5: their sum clamped; 6: squared; 7: sine; 8:
// the angle; 9: one or nothing; 10: the lesser of it and 0; 11: the larger of it and 0.1; 12: at most 1; 13:
// nothing or one; 14: one more; 15 and 16: that of light 0 or 1 is not clamped; 17: one minus it
uniform int u_Cosine;
uniform float u_CosineMax;
uniform float u_CosinePower;
uniform int u_PlaceUnit; // 1: the point is normalized

uniform vec3 u_Base[2];      // ambient light on the front and the back
uniform int u_Ambient;       // 3: times each light's cosine; 6: the larger of the two; 10: not where it
                             // is lit; 11: not in the cone; 12: only where it is lit; else: added
uniform int u_Lights;        // how many
uniform vec3 u_Diffuse[4];   // of light 0 and 1 on the front, then on the back
uniform vec3 u_Highlight[2]; // of light 0 and 1
uniform float u_Exponent;
// 0: none; 1: Phong; 2: Blinn-Phong; 3: reflect's sign; 4: L + V halved; 5: L + V; 6: of L - V; 7: N.V;
// 8: L.V; 9: H.V; 10 and 11: N reflected at -L and L; 12: Blinn-Phong of vectors not normalized; 13:
// R.H; 14: R is (N.L) N - L
uniform int u_Reflection;
uniform int u_Gate;  // 0: if the cosine is positive; 1: always; 2: times the cosine
// of the cosine: 0: clamped; 1: as it is; 2: absolute; 3: as the exponent; 4: as a factor; 5: clamped
// after the power; 6: at most 1; 7: the power approximated
uniform int u_Power;
uniform vec3 u_View;
uniform mat4 u_ViewPlace; // V is u_View minus this times the point
uniform int u_ViewUnit;

uniform vec3 u_Fade;    // constant, linear, quadratic
uniform int u_FadeMode; // 2: multiplied by; 3: of the squared distance; 5: of that to the eye; 6:
                        // divided by twice; else: divided by
uniform vec3 u_FadeOn;  // 1 for each of diffuse, specular, ambient
uniform vec3 u_SpotAxis;
uniform float u_SpotCosine;
uniform float u_SpotExponent;
uniform int u_SpotOutside;
uniform vec3 u_SpotOn;
uniform int u_SpotShape; // 1: linear between the cosine of the cutoff and 1; 2: smoothstep
uniform vec3 u_Limit[2]; // of the light times the surface, on the front and the back
uniform int u_LimitOf;   // 1: with the ambient light; 2: without; 3: of each light
uniform vec3 u_Plus;     // added at the end
uniform int u_Product;   // 1: lights are multiplied; 2: the larger of them

float g_Visible = 1.0;   // of the light: less in a shadow
#ifdef SHADOWS
uniform vec3 u_ShadowOn; // 1 for each of diffuse, specular, ambient that a shadow keeps off
#endif

float cosine_of(float c, int light) {
    if (u_Cosine == 15 + light)
        return c;
    if (u_Cosine == 15 || u_Cosine == 16)
        return max(c, 0.0);
    if (u_Cosine == 14)
        return max(c + 1.0, 0.0);
    if (u_Cosine == 17)
        return 1.0 - max(c, 0.0);
    if (u_Cosine == 0)
        return max(c, 0.0);
    if (u_Cosine == 2)
        return abs(c);
    if (u_Cosine == 3)
        return 1.0;
    if (u_Cosine == 4)
        return 0.5 * c + 0.5;
    if (u_Cosine == 6)
        return max(c, 0.0) * max(c, 0.0);
    if (u_Cosine == 7)
        return sqrt(max(1.0 - c * c, 0.0));
    if (u_Cosine == 8)
        return acos(clamp(c, -1.0, 1.0));
    if (u_Cosine == 9)
        return c > 0.0 ? 1.0 : 0.0;
    if (u_Cosine == 13)
        return c > 0.0 ? 0.0 : 1.0;
    if (u_Cosine == 10)
        return min(c, 0.0);
    if (u_Cosine == 12)
        return clamp(c, 0.0, 1.0);
    return u_Cosine == 11 ? max(c, 0.1) : c;
}

float highlight(vec3 n, vec3 l, vec3 v, vec3 raw) {
    float c = 0.0;
    if (u_Reflection == 1)
        c = dot(reflect(-l, n), v);
    else if (u_Reflection == 2)
        c = dot(n, normalize(l + v));
    else if (u_Reflection == 3)
        c = dot(reflect(l, n), v);
    else if (u_Reflection == 4)
        c = dot(n, 0.5 * (l + v));
    else if (u_Reflection == 5)
        c = dot(n, l + v);
    else if (u_Reflection == 6)
        c = dot(n, normalize(l - v));
    else if (u_Reflection == 7)
        c = dot(n, v);
    else if (u_Reflection == 8)
        c = dot(l, v);
    else if (u_Reflection == 9)
        c = dot(normalize(l + v), v);
    else if (u_Reflection == 12)
        c = dot(n, normalize(raw));
    else if (u_Reflection == 13)
        c = dot(reflect(-l, n), normalize(l + v));
    else if (u_Reflection == 14)
        c = dot(dot(n, l) * n - l, v);
    else
        c = dot(reflect(n, u_Reflection == 10 ? -l : l), v);
    if (u_Power == 1)
        return pow(c, u_Exponent);
    if (u_Power == 3)
        return pow(u_Exponent, max(c, 0.0));
    if (u_Power == 4)
        return max(c, 0.0) * u_Exponent;
    if (u_Power == 5)
        return max(pow(c, u_Exponent), 0.0);
    if (u_Power == 6)
        return pow(clamp(c, 0.0, 1.0), u_Exponent);
    if (u_Power == 7)
        return max(c, 0.0) / (u_Exponent - (u_Exponent - 1.0) * max(c, 0.0));
    return pow(u_Power == 2 ? abs(c) : max(c, 0.0), u_Exponent);
}

float fading(float d) {
    if (u_FadeMode == 3)
        d *= d;
    float sum = u_Fade.x + u_Fade.y * d + u_Fade.z * d * d;
    return u_FadeMode == 2 ? sum : u_FadeMode == 6 ? 1.0 / (sum * sum) : 1.0 / sum;
}

float cone(vec3 l) {
    float along = dot(-l, u_SpotAxis);
    bool inside = along >= u_SpotCosine;
    if (u_SpotOutside == 1)
        inside = !inside;
    if (u_SpotShape == 1)
        return inside ? (along - u_SpotCosine) / (1.0 - u_SpotCosine) : 0.0;
    if (u_SpotShape == 3)
        return inside ? pow((along - u_SpotCosine) / (1.0 - u_SpotCosine), u_SpotExponent) : 0.0;
    if (u_SpotShape == 2)
        return smoothstep(u_SpotCosine, 1.0, along);
    return inside ? pow(max(along, 0.0), u_SpotExponent) : 0.0;
}

// What all lights add.
struct Sum {
    vec3 diffuse, specular, ambient;
    bool lit, inside; // by a light; in its cone
};

void add_light(inout Sum sum, int light, vec3 place, vec3 n, vec3 v, vec3 toward, vec3 base,
               vec3 diffuse, vec3 limit) {
    // Browsers index by constants alone.
    vec3 source = light == 0 ? u_Light[0] : u_Light[1];
    vec3 specular = light == 0 ? u_Highlight[0] : u_Highlight[1];
    vec3 way = source - u_FromPlace * place;
    vec3 l = u_LightSign * (u_LightUnit == 1 ? way : u_LightUnit == 0 ? normalize(way) : toward);
    vec3 share = mix(vec3(1.0), vec3(fading(length(u_FadeMode == 5 ? u_View - place : way))),
                     u_FadeOn);
    share *= mix(vec3(1.0), vec3(cone(l)), u_SpotOn);
#ifdef SHADOWS
    share *= mix(vec3(1.0), vec3(g_Visible), u_ShadowOn);
#endif
    float c = dot(n, l);
    float shown = min(cosine_of(c, light), u_CosineMax);
    if (u_CosinePower != 1.0)
        shown = pow(max(shown, 0.0), u_CosinePower);
    vec3 shone = share.x * diffuse * shown;
    sum.diffuse += u_LimitOf == 3 ? min(shone, limit) : shone;
    sum.inside = sum.inside || share.x > 0.0;
    sum.lit = sum.lit || (share.x > 0.0 && c > 0.0);
    if (u_Reflection != 0 && share.y > 0.0 && (c > 0.0 || u_Gate == 1)) {
        float h = highlight(n, l, v, way + u_View - place);
        sum.specular += share.y * specular * (u_Gate == 2 ? h * shown : h);
    }
    sum.ambient += share.z * base * (u_Ambient == 3 ? shown : 1.0);
}

// `back`: 1 for the back's colours.
vec3 shade(vec3 place, vec3 n, vec3 toward0, vec3 toward1, int back) {
    vec3 v = u_View - vec3(u_ViewPlace * vec4(place, 1.0));
    if (u_ViewUnit == 1)
        v = normalize(v);
    if (u_PlaceUnit == 1)
        place = normalize(place);
    vec3 base = back == 1 ? u_Base[1] : u_Base[0];
    vec3 limit = back == 1 ? u_Limit[1] : u_Limit[0];
    Sum sum = Sum(vec3(0.0), vec3(0.0), vec3(0.0), false, false);
    // The first light carries the ambient light; u_Base already has any factor per light.
    add_light(sum, 0, place, n, v, toward0, base, back == 1 ? u_Diffuse[2] : u_Diffuse[0], limit);
    if (u_Lights == 2) {
        vec3 first = sum.diffuse;
        if (u_Product != 0)
            sum.diffuse = vec3(0.0);
        add_light(sum, 1, place, n, v, toward1, u_Ambient == 3 ? base : vec3(0.0),
                  back == 1 ? u_Diffuse[3] : u_Diffuse[1], limit);
        if (u_Product == 1)
            sum.diffuse *= first / max(limit, 1e-6);
        else if (u_Product == 2)
            sum.diffuse = max(sum.diffuse, first);
    }
    if (u_Cosine == 5)
        sum.diffuse = max(sum.diffuse, 0.0);
    if ((u_Ambient == 10 && sum.lit) || (u_Ambient == 11 && sum.inside) || (u_Ambient == 12 && !sum.lit))
        sum.ambient = vec3(0.0);
    if (u_LimitOf == 2)
        sum.diffuse = min(sum.diffuse, limit);
    vec3 color = u_Ambient == 6 ? max(sum.diffuse, sum.ambient) : sum.diffuse + sum.ambient;
    if (u_LimitOf == 1)
        color = min(color, limit);
    color += sum.specular;
    if (u_Ambient == 6)
        color = max(sum.diffuse + sum.specular, sum.ambient);
    return color + u_Plus;
}
