precision mediump float;
uniform vec3 u_AmbientLight;
varying vec3 v_irradiance;
varying vec3 v_albedo;
void main() {
    gl_FragColor = vec4(min((v_irradiance + u_AmbientLight) * v_albedo, 1.0), 1.0);
}
