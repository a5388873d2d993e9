// Lab 11: light each fragment, unless something is between it and the light.

#ifdef GL_FRAGMENT_PRECISION_HIGH
precision highp float;
#else
precision mediump float;
#endif

uniform vec3 u_LightColor;
uniform vec3 u_LightPosition; // world space
uniform vec3 u_AmbientLight;
uniform highp sampler2D u_ShadowMap; // what the light sees: depths, packed

varying vec4 v_Color;
varying vec3 v_Normal;        // world space
varying vec3 v_Position;      // world space
varying vec4 v_LightPosition; // the light's clip space

const float BIAS = 0.002;

// The map's depth, 0 to 1, at a place from (0, 0) to (1, 1).
float mapDepth(vec2 place) {
    return dot(texture2D(u_ShadowMap, place).rgb, vec3(1.0, 1.0 / 255.0, 1.0 / 65025.0));
}

// 1 in light, 0 in shadow.
float visibility() {
    vec3 place = 0.5 * v_LightPosition.xyz / v_LightPosition.w + 0.5;
    if (place.x < 0.0 || place.x > 1.0 || place.y < 0.0 || place.y > 1.0)
        return 1.0;
    return place.z - BIAS <= mapDepth(place.xy) ? 1.0 : 0.0;
}

void main() {
    vec3 normal = normalize(v_Normal);
    vec3 lightDirection = normalize(u_LightPosition - v_Position);
    float nDotL = max(dot(lightDirection, normal), 0.0);
    vec3 light = u_AmbientLight + visibility() * u_LightColor * nDotL;
    gl_FragColor = vec4(light * v_Color.rgb, v_Color.a);
}
