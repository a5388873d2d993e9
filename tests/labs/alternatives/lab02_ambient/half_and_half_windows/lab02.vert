#version 100
attribute vec4 a_Position;
attribute vec4 a_Color;
attribute vec4 a_Normal;
uniform mat4 u_MvpMatrix;
uniform mat4 u_NormalMatrix;
uniform vec3 u_LightColor[2];
uniform vec3 u_LightDirection[2];
uniform vec3 u_AmbientLight;
varying vec4 v_Color;
const int N = 2;
void main() {
	vec3 normal = normalize(vec3(u_NormalMatrix * vec4(a_Normal.xyz, 0.0)));
	vec3 c = vec3(0);
	for (int i = 0; i < N; i += 1) {
		float k = clamp(dot(normalize(u_LightDirection[i]), normal), 0.0, 1.0);
		// half of the ambient light in each turn
		c += a_Color.rgb * (u_LightColor[i] * k + u_AmbientLight / float(N));
	}
	v_Color = vec4(c, a_Color.a);
	gl_Position = u_MvpMatrix * a_Position;
}
