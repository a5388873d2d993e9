precision highp float;
struct Light { vec3 position; vec3 color; };
uniform vec3 u_LightColor[2];
uniform vec3 u_LightPosition[2];
uniform vec3 u_AmbientLight;
varying vec3 v_Position;
varying vec3 v_Normal;
varying vec4 v_Color;

void shade(in Light light, in vec3 normal, inout vec3 sum) {
    vec3 direction = normalize(light.position - v_Position);
    float cosine = dot(direction, normal);
    sum += step(0.0, cosine) * cosine * light.color;
}

void main() {
    vec3 normal = normalize(v_Normal), sum = u_AmbientLight;
    for (int i = 0; i != 2; i++)
        shade(Light(u_LightPosition[i], u_LightColor[i]), normal, sum);
    gl_FragColor = v_Color * vec4(sum, 1.0);
}
