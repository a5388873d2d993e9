// PointLightedCube_animation: projects and lights each vertex.

attribute vec4 a_Position;
attribute vec4 a_Color;
attribute vec4 a_Normal;

uniform mat4 u_MvpMatrix;
uniform mat4 u_ModelMatrix;
uniform mat4 u_NormalMatrix; // inverse transpose of the model matrix
uniform vec3 u_LightColor;
uniform vec3 u_LightPosition; // world coordinates
uniform vec3 u_AmbientLight;

varying vec4 v_Color;

void main() {
    gl_Position = u_MvpMatrix * a_Position;
    vec3 position = vec3(u_ModelMatrix * a_Position);
    vec3 normal = normalize(vec3(u_NormalMatrix * vec4(a_Normal.xyz, 0.0)));
    vec3 lightDirection = normalize(u_LightPosition - position);
    // Cosine of the angle between light and normal; 0 behind the surface.
    float nDotL = max(dot(lightDirection, normal), 0.0);
    vec3 diffuse = u_LightColor * a_Color.rgb * nDotL;
    vec3 ambient = u_AmbientLight * a_Color.rgb;
    v_Color = vec4(diffuse + ambient, a_Color.a);
}
