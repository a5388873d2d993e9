// R.V with the view reflected in the place of the light: the same number.
precision highp float;
uniform vec3 u_LightColor[2];
uniform vec3 u_LightPosition[2];
uniform vec3 u_AmbientLight;
uniform vec3 u_SpecularColor;
uniform vec3 u_EyePosition;
uniform float u_Shininess;
varying vec3 worldPos;
varying vec3 worldNormal;
varying vec4 baseColor;

vec3 phong(vec3 n, vec3 reflectedView, vec3 toLight, vec3 lightColor)
{
    vec3 l = normalize(toLight);
    float lit = dot(n, l);
    if (lit <= 0.0)
        return vec3(0.0);
    float s = dot(reflectedView, l);
    float highlight = s > 0.0 ? exp2(u_Shininess * log2(s)) : 0.0;
    return lightColor * (lit * baseColor.rgb + highlight * u_SpecularColor);
}

void main()
{
    vec3 n = normalize(worldNormal);
    vec3 r = reflect(normalize(worldPos - u_EyePosition), n);
    gl_FragColor = vec4(u_AmbientLight * baseColor.rgb
        + phong(n, r, u_LightPosition[0] - worldPos, u_LightColor[0])
        + phong(n, r, u_LightPosition[1] - worldPos, u_LightColor[1]), baseColor.a);
}
