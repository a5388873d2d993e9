// Light on a point, with or without mistakes. What a mode can be, and what it means, is in
// examples/labs/diagnosis/catalogue_choices.def, from which wrong_program.c defines it.

uniform int u_AtVertices;
uniform int u_NormalUnit;  // UNIT_: where normals are normalized
uniform vec3 u_Light[2];   // positions or directions
uniform float u_FromPlace; // 1: the direction to the light starts at the point
uniform int u_LightUnit;   // UNIT_
uniform float u_LightSign;
uniform int u_Cosine;      // COSINE_
uniform float u_CosineMax;
uniform float u_CosinePower;
uniform int u_PlaceUnit; // 1: the point is normalized

uniform vec3 u_Base[2];      // ambient light on the front and the back
uniform int u_Ambient;       // AMBIENT_
uniform int u_Lights;        // how many
uniform vec3 u_Diffuse[4];   // of light 0 and 1 on the front, then on the back
uniform vec3 u_Highlight[2]; // of light 0 and 1
uniform float u_Exponent;
uniform int u_Reflection;    // REFLECTION_
uniform int u_Gate;          // GATE_
uniform int u_Power;         // POWER_
uniform vec3 u_View;
uniform mat4 u_ViewPlace; // V is u_View minus this times the point
uniform int u_ViewUnit;

uniform vec3 u_Fade;    // constant, linear, quadratic
uniform int u_FadeMode; // FADE_
uniform vec3 u_FadeOn;  // 1 for each of diffuse, specular, ambient
uniform vec3 u_SpotAxis;
uniform float u_SpotCosine;
uniform float u_SpotExponent;
uniform int u_SpotOutside;
uniform vec3 u_SpotOn;
uniform int u_SpotShape; // FALL_OFF_
uniform vec3 u_Limit[2]; // of the light times the surface, on the front and the back
uniform int u_LimitOf;   // LIMIT_
uniform vec3 u_Plus;     // added at the end
uniform int u_LightsOf;  // LIGHTS_

float g_Visible = 1.0;   // of the light: less in a shadow
#ifdef SHADOWS
uniform vec3 u_ShadowOn; // 1 for each of diffuse, specular, ambient that a shadow keeps off
#endif

float cosine_of(float c, int light) {
    if (u_Cosine == COSINE_UNCLAMPED_FIRST + light)
        return c;
    if (u_Cosine == COSINE_UNCLAMPED_FIRST || u_Cosine == COSINE_UNCLAMPED_SECOND)
        return max(c, 0.0);
    if (u_Cosine == COSINE_PLUS_ONE)
        return max(c + 1.0, 0.0);
    if (u_Cosine == COSINE_INVERTED)
        return 1.0 - max(c, 0.0);
    if (u_Cosine == COSINE_RIGHT)
        return max(c, 0.0);
    if (u_Cosine == COSINE_ABSOLUTE)
        return abs(c);
    if (u_Cosine == COSINE_NONE)
        return 1.0;
    if (u_Cosine == COSINE_WRAPPED)
        return 0.5 * c + 0.5;
    if (u_Cosine == COSINE_SQUARED)
        return max(c, 0.0) * max(c, 0.0);
    if (u_Cosine == COSINE_SINE)
        return sqrt(max(1.0 - c * c, 0.0));
    if (u_Cosine == COSINE_ANGLE)
        return acos(clamp(c, -1.0, 1.0));
    if (u_Cosine == COSINE_STEP)
        return c > 0.0 ? 1.0 : 0.0;
    if (u_Cosine == COSINE_STEP_REVERSED)
        return c > 0.0 ? 0.0 : 1.0;
    if (u_Cosine == COSINE_MIN)
        return min(c, 0.0);
    if (u_Cosine == COSINE_SATURATED)
        return clamp(c, 0.0, 1.0);
    return u_Cosine == COSINE_FLOOR ? max(c, 0.1) : c;
}

float highlight(vec3 n, vec3 l, vec3 v, vec3 raw) {
    float c = 0.0;
    if (u_Reflection == REFLECTION_AS_PHONG)
        c = dot(reflect(-l, n), v);
    else if (u_Reflection == REFLECTION_AS_BLINN_PHONG)
        c = dot(n, normalize(l + v));
    else if (u_Reflection == REFLECTION_SIGN)
        c = dot(reflect(l, n), v);
    else if (u_Reflection == REFLECTION_HALF_RAW)
        c = dot(n, 0.5 * (l + v));
    else if (u_Reflection == REFLECTION_SUM)
        c = dot(n, l + v);
    else if (u_Reflection == REFLECTION_HALF_DIFFERENCE)
        c = dot(n, normalize(l - v));
    else if (u_Reflection == REFLECTION_N_V)
        c = dot(n, v);
    else if (u_Reflection == REFLECTION_L_V)
        c = dot(l, v);
    else if (u_Reflection == REFLECTION_H_V)
        c = dot(normalize(l + v), v);
    else if (u_Reflection == REFLECTION_RAW_HALF)
        c = dot(n, normalize(raw));
    else if (u_Reflection == REFLECTION_R_H)
        c = dot(reflect(-l, n), normalize(l + v));
    else if (u_Reflection == REFLECTION_ONE)
        c = dot(dot(n, l) * n - l, v);
    else
        c = dot(reflect(n, u_Reflection == REFLECTION_SWAPPED ? -l : l), v);
    if (u_Power == POWER_ANY)
        return pow(c, u_Exponent);
    if (u_Power == POWER_SWAPPED)
        return pow(u_Exponent, max(c, 0.0));
    if (u_Power == POWER_FACTOR)
        return max(c, 0.0) * u_Exponent;
    if (u_Power == POWER_CLAMPED_LATE)
        return max(pow(c, u_Exponent), 0.0);
    if (u_Power == POWER_SATURATED)
        return pow(clamp(c, 0.0, 1.0), u_Exponent);
    if (u_Power == POWER_SCHLICK)
        return max(c, 0.0) / (u_Exponent - (u_Exponent - 1.0) * max(c, 0.0));
    return pow(u_Power == POWER_ABSOLUTE ? abs(c) : max(c, 0.0), u_Exponent);
}

float fading(float d) {
    if (u_FadeMode == FADE_SQUARED)
        d *= d;
    float sum = u_Fade.x + u_Fade.y * d + u_Fade.z * d * d;
    if (u_FadeMode == FADE_INVERTED)
        return sum;
    return u_FadeMode == FADE_TWICE ? 1.0 / (sum * sum) : 1.0 / sum;
}

float cone(vec3 l) {
    float along = dot(-l, u_SpotAxis);
    bool inside = along >= u_SpotCosine;
    if (u_SpotOutside == 1)
        inside = !inside;
    if (u_SpotShape == FALL_OFF_LINEAR)
        return inside ? (along - u_SpotCosine) / (1.0 - u_SpotCosine) : 0.0;
    if (u_SpotShape == FALL_OFF_LINEAR_POWER)
        return inside ? pow((along - u_SpotCosine) / (1.0 - u_SpotCosine), u_SpotExponent) : 0.0;
    if (u_SpotShape == FALL_OFF_SMOOTH)
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
    vec3 l = u_LightUnit == UNIT_NEVER ? way : u_LightUnit == UNIT_RIGHT ? normalize(way) : toward;
    l *= u_LightSign;
    float distance = length(u_FadeMode == FADE_EYE ? u_View - place : way);
    vec3 share = mix(vec3(1.0), vec3(fading(distance)), u_FadeOn);
    share *= mix(vec3(1.0), vec3(cone(l)), u_SpotOn);
#ifdef SHADOWS
    share *= mix(vec3(1.0), vec3(g_Visible), u_ShadowOn);
#endif
    float c = dot(n, l);
    float shown = min(cosine_of(c, light), u_CosineMax);
    if (u_CosinePower != 1.0)
        shown = pow(max(shown, 0.0), u_CosinePower);
    vec3 shone = share.x * diffuse * shown;
    sum.diffuse += u_LimitOf == LIMIT_EACH ? min(shone, limit) : shone;
    sum.inside = sum.inside || share.x > 0.0;
    sum.lit = sum.lit || (share.x > 0.0 && c > 0.0);
    if (u_Reflection != REFLECTION_NONE && share.y > 0.0 && (c > 0.0 || u_Gate == GATE_OPEN)) {
        float h = highlight(n, l, v, way + u_View - place);
        sum.specular += share.y * specular * (u_Gate == GATE_COSINE ? h * shown : h);
    }
    sum.ambient += share.z * base * (u_Ambient == AMBIENT_COSINE ? shown : 1.0);
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
        if (u_LightsOf == LIGHTS_PRODUCT || u_LightsOf == LIGHTS_LARGER)
            sum.diffuse = vec3(0.0);
        add_light(sum, 1, place, n, v, toward1, u_Ambient == AMBIENT_COSINE ? base : vec3(0.0),
                  back == 1 ? u_Diffuse[3] : u_Diffuse[1], limit);
        if (u_LightsOf == LIGHTS_PRODUCT)
            sum.diffuse *= first / max(limit, 1e-6);
        else if (u_LightsOf == LIGHTS_LARGER)
            sum.diffuse = max(sum.diffuse, first);
    }
    if (u_Cosine == COSINE_SUM_CLAMPED)
        sum.diffuse = max(sum.diffuse, 0.0);
    if ((u_Ambient == AMBIENT_NOT_LIT && sum.lit) || (u_Ambient == AMBIENT_ONLY_LIT && !sum.lit) ||
        (u_Ambient == AMBIENT_NOT_CONE && sum.inside))
        sum.ambient = vec3(0.0);
    if (u_LimitOf == LIMIT_DIFFUSE)
        sum.diffuse = min(sum.diffuse, limit);
    vec3 color = sum.diffuse + sum.ambient;
    if (u_Ambient == AMBIENT_LARGER)
        color = max(sum.diffuse, sum.ambient);
    if (u_LimitOf == LIMIT_ALL)
        color = min(color, limit);
    color += sum.specular;
    if (u_Ambient == AMBIENT_LARGER)
        color = max(sum.diffuse + sum.specular, sum.ambient);
    return color + u_Plus;
}
