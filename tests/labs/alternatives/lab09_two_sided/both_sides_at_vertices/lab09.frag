precision highp float;
uniform vec3 u_LightColor;
uniform vec3 u_LightPosition;
uniform vec3 u_AmbientLight;
uniform vec4 u_BackColor;
uniform float u_Mirrored;
varying vec3 v_Position;
varying vec3 v_Normal;
varying vec4 v_Color;
vec4 lit(vec3 n, vec4 color) {
    vec3 l = normalize(u_LightPosition - v_Position);
    return vec4(color.rgb * (u_AmbientLight + u_LightColor * max(dot(n, l), 0.0)), color.a);
}
void main() {
    vec3 n = normalize(v_Normal);
    vec4 front = lit(n, v_Color), back = lit(-n, u_BackColor);
    if (u_Mirrored < 0.0)
        gl_FragColor = gl_FrontFacing ? back : front;
    else
        gl_FragColor = gl_FrontFacing ? front : back;
}
