// Light on a point, with or without mistakes.

uniform int u_AtVertices;
// Normals: 0: as they come; 1: made unit at the vertices; 2: where light is computed; 3: both.
uniform int u_NormalUnit;
uniform vec3 u_Light[2];  // places or directions
uniform float u_FromPlace; // 1: the direction to the light is from the point
uniform int u_LightUnit;   // 0: as it comes; 1: made unit; 2: at the vertices alone
uniform float u_LightSign;
uniform int u_Cosine; // 0: clamped; 1: not; 2: absolute; 3: none; 4: wrapped

uniform vec3 u_Base[2];        // ambient light on the front and the back
uniform int u_AmbientMode;     // 0: added; 1: times each light's cosine; 2: the larger of the two
uniform int u_Lights;          // how many there are
uniform vec3 u_Diffuse[4];     // of light 0 and 1 on the front, then on the back
uniform vec3 u_Highlight[2];   // of light 0 and 1
uniform float u_Exponent;
uniform int u_Reflection; // 0: none; 1: Phong; 2: Blinn-Phong; 3: reflect's sign; 4: half not unit
uniform int u_Gate;       // 0: where the cosine is positive; 1: everywhere; 2: times the cosine
uniform int u_Power;      // 0: of what is not negative; 1: of anything; 2: of the absolute value
uniform vec3 u_View;
uniform mat4 u_ViewPlace; // V is u_View less this times the point
uniform int u_ViewUnit;

uniform vec3 u_Fade; // constant, linear, quadratic
uniform int u_FadeMode; // 0: divided by; 1: multiplied with; 2: of the distance's square
uniform vec3 u_FadeOn;  // 1 for each of diffuse, specular, ambient
uniform vec3 u_SpotAxis;
uniform float u_SpotCosine;
uniform float u_SpotExponent;
uniform int u_SpotOutside;
uniform vec3 u_SpotOn;

float cosine_of(float c) {
    if (u_Cosine == 0)
        return max(c, 0.0);
    if (u_Cosine == 2)
        return abs(c);
    if (u_Cosine == 3)
        return 1.0;
    return u_Cosine == 4 ? 0.5 * c + 0.5 : c;
}

float highlight(vec3 n, vec3 l, vec3 v) {
    float c = 0.0;
    if (u_Reflection == 1)
        c = dot(reflect(-l, n), v);
    else if (u_Reflection == 2)
        c = dot(n, normalize(l + v));
    else if (u_Reflection == 3)
        c = dot(reflect(l, n), v);
    else
        c = dot(n, 0.5 * (l + v));
    if (u_Power == 1)
        return pow(c, u_Exponent);
    return pow(u_Power == 2 ? abs(c) : max(c, 0.0), u_Exponent);
}

float fading(float d) {
    if (u_FadeMode == 2)
        d *= d;
    float sum = u_Fade.x + u_Fade.y * d + u_Fade.z * d * d;
    return u_FadeMode == 1 ? sum : 1.0 / sum;
}

float cone(vec3 l) {
    float along = dot(-l, u_SpotAxis);
    bool inside = along >= u_SpotCosine;
    if (u_SpotOutside == 1)
        inside = !inside;
    return inside ? pow(max(along, 0.0), u_SpotExponent) : 0.0;
}

vec3 one_light(vec3 place, vec3 n, vec3 v, vec3 source, vec3 toward, vec3 base, vec3 diffuse,
               vec3 specular) {
    vec3 way = source - u_FromPlace * place;
    vec3 l = u_LightSign * (u_LightUnit == 0 ? way : u_LightUnit == 1 ? normalize(way) : toward);
    vec3 share = mix(vec3(1.0), vec3(fading(length(way))), u_FadeOn);
    share *= mix(vec3(1.0), vec3(cone(l)), u_SpotOn);
    float c = dot(n, l);
    float shown = cosine_of(c);
    vec3 sum = share.x * diffuse * shown;
    if (u_Reflection != 0 && share.y > 0.0 && (c > 0.0 || u_Gate == 1)) {
        float h = highlight(n, l, v);
        sum += share.y * specular * (u_Gate == 2 ? h * shown : h);
    }
    if (u_AmbientMode == 2)
        return max(sum, base);
    return sum + share.z * base * (u_AmbientMode == 1 ? shown : 1.0);
}

// `back`: 1 for the back's colours.
vec3 shade(vec3 place, vec3 n, vec3 toward0, vec3 toward1, int back) {
    vec3 v = u_View - vec3(u_ViewPlace * vec4(place, 1.0));
    if (u_ViewUnit == 1)
        v = normalize(v);
    vec3 base = back == 1 ? u_Base[1] : u_Base[0];
    // Ambient light belongs to the first; what is per light is multiplied already.
    vec3 color = one_light(place, n, v, u_Light[0], toward0, base,
                           back == 1 ? u_Diffuse[2] : u_Diffuse[0], u_Highlight[0]);
    vec3 other = u_AmbientMode == 1 ? base : vec3(0.0);
    if (u_Lights == 1)
        return color;
    return color + one_light(place, n, v, u_Light[1], toward1, other,
                             back == 1 ? u_Diffuse[3] : u_Diffuse[1], u_Highlight[1]);
}
