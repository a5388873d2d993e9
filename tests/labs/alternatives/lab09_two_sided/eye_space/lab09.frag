precision highp float;
uniform mat4 u_ViewMatrix;
uniform vec3 u_LightColor, u_LightPosition, u_AmbientLight;
uniform vec4 u_BackColor;
uniform float u_Mirrored;
varying vec3 v_EyePosition, v_EyeNormal;
varying vec4 v_Color;
void main() {
    float side = (gl_FrontFacing ? 1.0 : -1.0) * u_Mirrored;
    vec3 normal = side * normalize(v_EyeNormal);
    vec3 light = (u_ViewMatrix * vec4(u_LightPosition, 1.0)).xyz - v_EyePosition;
    float nDotL = max(dot(normal, normalize(light)), 0.0);
    vec4 color = side > 0.0 ? v_Color : u_BackColor;
    gl_FragColor = vec4((u_AmbientLight + u_LightColor * nDotL) * color.rgb, 1.0);
}
