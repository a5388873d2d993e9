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
uniform float u_ShadowMapSize; // in texels

varying vec4 v_Color;
varying vec3 v_Normal;        // world space
varying vec3 v_Position;      // world space
varying vec4 v_LightPosition; // the light's clip space

// The map's depth, 0 to 1, at a place from (0, 0) to (1, 1).
float mapDepth(vec2 place) {
    return dot(texture2D(u_ShadowMap, place).rgb, vec3(1.0, 1.0 / 255.0, 1.0 / 65025.0));
}

// 1 in light, 0 in shadow.
float visibility() {
    // To do: this is not yet the place on the map, nor the depth that the map has.
    vec3 place = v_LightPosition.xyz;
    // To do: beside the map it is light; and what the light sees must not shadow itself.
    return place.z <= mapDepth(place.xy) ? 1.0 : 0.0;
}

void main() {
    vec3 normal = normalize(v_Normal);
    vec3 lightDirection = normalize(u_LightPosition - v_Position);
    float nDotL = max(dot(lightDirection, normal), 0.0);
    // To do: which of the two does a shadow keep off?
    vec3 light = u_AmbientLight + u_LightColor * nDotL;
    gl_FragColor = vec4(visibility() * light * v_Color.rgb, v_Color.a);
}
