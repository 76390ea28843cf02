// Programs of the graphics processor. Places are metres from the model's middle; u_view: centre x, y, and clip units a metre.

const VIEW = `#version 300 es
precision highp float;
precision highp int;
uniform vec4 u_view;
vec4 clip(vec2 place) { return vec4((place - u_view.xy) * u_view.zw, 0.0, 1.0); }
`;

// Vertices are given in the axes of their block; where that is, and its colour, stand in textures: new ones for each frame, and nothing else.
const BLOCK = `${VIEW}
uniform highp sampler2D u_pose;
uniform highp sampler2D u_colour;
in vec2 a_local;
in uint a_block;
flat out vec4 v_colour;
void main() {
    ivec2 place = ivec2(int(a_block & 1023u), int(a_block >> 10));
    vec4 pose = texelFetch(u_pose, place, 0);
    v_colour = texelFetch(u_colour, place, 0);
    vec2 turned = vec2(pose.z * a_local.x - pose.w * a_local.y, pose.w * a_local.x + pose.z * a_local.y);
    gl_Position = v_colour.a == 0.0 ? vec4(2.0, 2.0, 2.0, 1.0) : clip(pose.xy + turned);
}`;

// The fourth number of a colour (colours.js): 0 gone, below 0.6 hatched.
const HATCH = `
uniform float u_ratio;
vec4 painted(vec4 colour) {
    bool stripe = colour.a < 0.6 && mod((gl_FragCoord.x + gl_FragCoord.y) / u_ratio, 7.0) < 2.2;
    return vec4(stripe ? vec3(0.835, 0.369, 0.0) : colour.rgb, 1.0);
}`;

export const FACES = [BLOCK, `#version 300 es
precision highp float;
${HATCH}
flat in vec4 v_colour;
out vec4 colour;
void main() { colour = painted(v_colour); }`];

export const EDGES = [BLOCK, `#version 300 es
precision highp float;
uniform vec4 u_ink;
flat in vec4 v_colour;
out vec4 colour;
void main() { colour = u_ink; }`];

// A line between two places, some pixels wide: four corners, once for each line.
export const LINES = [`${VIEW}
uniform vec2 u_size;
in vec2 a_corner;
in vec4 a_ends;
in float a_width;
in vec4 a_colour;
out vec4 v_colour;
void main() {
    vec2 from = clip(a_ends.xy).xy, to = clip(a_ends.zw).xy;
    vec2 along = (to - from) * u_size;
    float length = max(length(along), 1e-6);
    along = length > 1e-5 ? along / length : vec2(1.0, 0.0);
    vec2 across = vec2(-along.y, along.x);
    vec2 place = mix(from, to, a_corner.x) * u_size + across * a_corner.y * a_width + along * (a_corner.x * 2.0 - 1.0) * 0.35 * a_width;
    gl_Position = vec4(place / u_size, 0.0, 1.0);
    v_colour = a_colour;
}`, `#version 300 es
precision highp float;
in vec4 v_colour;
out vec4 colour;
void main() { colour = v_colour; }`];
