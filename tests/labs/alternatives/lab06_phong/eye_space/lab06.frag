precision mediump float;
uniform highp mat4 u_ViewMatrix;
uniform vec3 u_LightColor[2];
uniform highp vec3 u_LightPosition[2];
uniform vec3 u_AmbientLight;
uniform vec3 u_SpecularColor;
uniform float u_Shininess;
varying highp vec3 v_EyePosition;
varying highp vec3 v_EyeNormal;
varying vec4 v_Color;

void main() {
    highp vec3 n = normalize(v_EyeNormal);
    highp vec3 v = normalize(-v_EyePosition); // the eye is the origin
    vec3 diffuse = vec3(0.0), specular = vec3(0.0);
    for (int i = 0; i < 2; i++) {
        highp vec3 l = normalize(vec3(u_ViewMatrix * vec4(u_LightPosition[i], 1.0)) - v_EyePosition);
        highp float nl = dot(n, l);
        if (nl <= 0.0)
            continue;
        diffuse += nl * u_LightColor[i];
        specular += pow(max(dot(v, reflect(-l, n)), 0.0), u_Shininess) * u_LightColor[i];
    }
    vec3 c = (u_AmbientLight + diffuse) * v_Color.rgb + specular * u_SpecularColor;
    gl_FragColor = vec4(c, 1.0);
}
