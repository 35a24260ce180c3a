// SPDX-License-Identifier: BSD-3-Clause
// The programs of the graphics processor. The projection is parallel, so depth is linear and every ball is a true circle.
//
// Balls are drawn in two passes. The first writes, for every pixel, which ball is nearest and at what depth; it does next to
// nothing for each of the many fragments that another ball covers later. The second looks at each pixel once: colour, light,
// shade of the neighbourhood (ambient occlusion) and outlines between bodies.

/** Balls: texel of ball b of a data texture, as wide as TEXTURE_WIDTH of balls.ts. */
const FETCH = /* glsl */ `
ivec2 texel(uint b) { return ivec2(int(b & 511u), int(b >> 9u)); }
`;

export const BALL_VERTEX = /* glsl */ `
precision highp float;
precision highp int;
uniform mat4 viewMatrix, projectionMatrix;
uniform highp sampler2D balls;   // centre and radius, mm
uniform vec4 cut;                // plane: dot(cut.xyz, p) > cut.w is hidden; 0, 0, 0, 1e9: no cut
flat out uint id;
flat out vec3 clip;              // plane in the units of the disc: hidden where dot(clip.xy, corner) + clip.z * height > 1
out vec2 disc;
out float depth;
flat out float reach;            // of the radius, in units of depth
${FETCH}
// Of a triangle around the unit disc.
const vec2 corners[3] = vec2[3](vec2(-1.7320508, -1.0), vec2(1.7320508, -1.0), vec2(0.0, 2.0));
void main() {
  uint ball = uint(gl_VertexID) / 3u;
  vec2 corner = corners[uint(gl_VertexID) - 3u * ball];
  vec4 b = texelFetch(balls, texel(ball), 0);
  float room = cut.w - dot(cut.xyz, b.xyz);
  vec4 centre = viewMatrix * vec4(b.xyz, 1.0);
  vec4 place = projectionMatrix * vec4(centre.xyz + vec3(corner * b.w, 0.0), 1.0);
  // A ball that is hidden as a whole leaves the view.
  gl_Position = room < -b.w ? vec4(2.0, 2.0, 2.0, 1.0) : place;
  id = ball + 1u;
  disc = corner;
  depth = place.z * 0.5 + 0.5;
  reach = -projectionMatrix[2][2] * 0.5 * b.w;
  clip = room < b.w ? vec3((mat3(viewMatrix) * cut.xyz).xy, 0.0) : vec3(0.0);
  clip.z = room < b.w ? room / b.w : 2.0;
}
`;

export const BALL_FRAGMENT = /* glsl */ `
precision highp float;
precision highp int;
uniform vec3 cutInView;          // normal of the cut, in the frame of the camera
flat in uint id;
flat in vec3 clip;
in vec2 disc;
in float depth;
flat in float reach;
layout(location = 0) out highp uint nearest;
void main() {
  float inside = 1.0 - dot(disc, disc);
  if (inside < 0.0) discard;
  float height = sqrt(inside);
  if (clip.z < 1.5) {
    float along = dot(clip.xy, disc);
    // Where the near side of the ball is cut off, the ray may still meet the section inside the ball.
    if (along + cutInView.z * height > clip.z) {
      if (cutInView.z <= 1e-4) discard;
      float section = (clip.z - along) / cutInView.z;
      if (section < -height) discard;
      height = section;
    }
  }
  gl_FragDepth = depth - height * reach;
  nearest = id;
}
`;

export const SCREEN_VERTEX = /* glsl */ `
precision highp float;
out vec2 at;
void main() {
  // One triangle that holds the whole picture.
  vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  at = corner * 0.5 + 0.5;
  gl_Position = vec4(corner, 0.0, 1.0);
}
`;

export const SHADE_FRAGMENT = /* glsl */ `
precision highp float;
precision highp int;
uniform highp usampler2D nearest;
uniform highp sampler2D depths;
uniform highp sampler2D balls;
uniform highp sampler2D colours; // of each ball; alpha tells neighbouring bodies apart
uniform mat4 ballView, ballProjection;
uniform float deep;              // from the near to the far end of what is seen, mm
uniform vec2 pixels;
uniform vec3 cutInView;
uniform vec3 paper;
uniform float occlusion;         // strength; 0: none
uniform float reachOfShade;      // mm
uniform int samples;
uniform float turn;              // of the pattern of samples, differs from sample to sample of the average
uniform float plain;             // 0: light as on a solid body, 1: colours stay close to those of their scale
uniform float ghost;             // 0: solid grains, 1: nothing left but paper
uniform float lineWidth;         // pixels
in vec2 at;
layout(location = 0) out vec4 colour;
${FETCH}
float depthAt(ivec2 p) { return texelFetch(depths, clamp(p, ivec2(0), ivec2(pixels) - 1), 0).r; }
uint ballAt(ivec2 p) { return texelFetch(nearest, clamp(p, ivec2(0), ivec2(pixels) - 1), 0).r; }
float mark(uint id) { return id == 0u ? -1.0 : texelFetch(colours, texel(id - 1u), 0).a; }

// How much of the sky over the point is taken by what stands around it. Source of the estimator: McGuire et al. (2011),
// The Alchemy screen-space ambient obscurance algorithm.
float openness(ivec2 p, float z, vec3 normal) {
  if (samples == 0 || occlusion == 0.0) return 1.0;
  float perPixel = 2.0 / (ballProjection[0][0] * pixels.x);
  float reach = min(reachOfShade / perPixel, 0.12 * pixels.y);
  float noise = fract(52.9829189 * fract(dot(vec2(p), vec2(0.06711056, 0.00583715))) + turn);
  float taken = 0.0;
  for (int k = 0; k < samples; ++k) {
    float share = (float(k) + 0.5) / float(samples);
    float angle = 6.2831853 * noise + 2.399963 * float(k);
    vec2 step = share * reach * vec2(cos(angle), sin(angle));
    ivec2 q = p + ivec2(step);
    float dz = (z - depthAt(q)) * deep;
    vec3 way = vec3(vec2(q - p) * perPixel, dz);
    float range = dot(way, way);
    float fade = clamp(1.0 - range / (reachOfShade * reachOfShade * 1.6), 0.0, 1.0);
    taken += fade * max(0.0, dot(way, normal) - 0.02 * reachOfShade) / (sqrt(range) * 0.6 + 0.02 * reachOfShade);
  }
  return max(0.0, 1.0 - occlusion * taken / float(samples));
}

void main() {
  ivec2 p = ivec2(gl_FragCoord.xy);
  uint id = ballAt(p);
  float z = depthAt(p);
  gl_FragDepth = ghost > 0.0 ? 1.0 : z;
  int w = int(max(1.0, floor(lineWidth + 0.5)));
  float own = mark(id), line = 0.0;
  ivec2 aside[4] = ivec2[4](ivec2(w, 0), ivec2(-w, 0), ivec2(0, w), ivec2(0, -w));
  if (id == 0u) {
    colour = vec4(paper, 1.0);
    return;
  }
  vec4 ball = texelFetch(balls, texel(id - 1u), 0);
  vec3 centre = (ballView * vec4(ball.xyz, 1.0)).xyz;
  vec2 onScreen = (gl_FragCoord.xy / pixels * 2.0 - 1.0 - ballProjection[3].xy) / vec2(ballProjection[0][0], ballProjection[1][1]);
  vec2 flatPart = (onScreen - centre.xy) / ball.w;
  float height = sqrt(max(0.0, 1.0 - dot(flatPart, flatPart)));
  vec3 normal = vec3(flatPart, height);
  // On a section the depth is behind the skin of the ball.
  float skin = -(centre.z + height * ball.w) / deep;
  bool section = z - skin > 0.02 * ball.w / deep;
  if (section) normal = cutInView;
  // Lines are drawn on the nearer of two bodies.
  for (int k = 0; k < 4; ++k) {
    ivec2 q = p + aside[k];
    if (mark(ballAt(q)) != own) line += section ? 1.0 : smoothstep(0.0, 0.5 * ball.w, (depthAt(q) - z) * deep + 0.2 * ball.w);
  }
  vec3 base = texelFetch(colours, texel(id - 1u), 0).rgb;
  float sky = openness(p, z, normal);
  float key = max(0.0, dot(normal, normalize(vec3(-0.45, 0.6, 0.75))));
  float fill = 0.5 + 0.5 * dot(normal, normalize(vec3(0.5, -0.2, 0.6)));
  float light = section ? 0.98 : 0.46 + 0.22 * fill + 0.5 * key;
  // Light that passes many grains takes some of their colour: shade is not black.
  vec3 shade = mix(0.08 + 0.3 * base, vec3(1.0), sky);
  vec3 lit = base * light * shade;
  float gleam = section ? 0.0 : 0.10 * pow(max(0.0, dot(normal, normalize(vec3(-0.28, 0.4, 1.0)))), 24.0);
  lit = mix(lit + gleam * sky, base * mix(1.0, shade.g, 0.8), 0.45 * plain);
  lit = mix(lit, lit * 0.32, min(1.0, 0.55 * line));
  colour = vec4(mix(lit, paper, ghost), 1.0);
}
`;

/** Rods (force chains, edges of walls): a strip that faces the viewer, with the depth and the normal of a cylinder. */
export const ROD_VERTEX = /* glsl */ `
precision highp float;
uniform mat4 viewMatrix, projectionMatrix;
uniform float leastRadius;       // mm, so that thin rods stay visible
in vec2 corner;                  // along: 0, 1; across: -1, 1
in vec3 start, end;
in vec4 tint;
in float radius;
out float across;
out float depth;
flat out vec3 side, front;
flat out float reach;
flat out vec4 colourOfRod;
void main() {
  vec3 a = (viewMatrix * vec4(start, 1.0)).xyz, b = (viewMatrix * vec4(end, 1.0)).xyz;
  vec3 way = b - a;
  float size = length(way);
  way = size > 0.0 ? way / size : vec3(0.0, 0.0, 1.0);
  vec2 onScreen = length(way.xy) > 1e-4 ? normalize(way.xy) : vec2(1.0, 0.0);
  side = vec3(-onScreen.y, onScreen.x, 0.0);
  front = normalize(cross(way, side));
  if (front.z < 0.0) front = -front;
  float r = max(radius, leastRadius);
  vec3 place = mix(a - 0.35 * r * way, b + 0.35 * r * way, corner.x) + side * (corner.y * r);
  gl_Position = projectionMatrix * vec4(place, 1.0);
  across = corner.y;
  depth = gl_Position.z * 0.5 + 0.5;
  reach = -projectionMatrix[2][2] * 0.5 * r;
  colourOfRod = tint;
}
`;

export const ROD_FRAGMENT = /* glsl */ `
precision highp float;
uniform vec3 paper;
uniform float fog;               // share of the paper's colour at the far end
uniform vec2 fogRange;           // depths at which it begins and ends
uniform float opacity;
in float across;
in float depth;
flat in vec3 side, front;
flat in float reach;
flat in vec4 colourOfRod;
layout(location = 0) out vec4 colour;
void main() {
  float height = sqrt(max(0.0, 1.0 - across * across));
  vec3 normal = side * across + front * height;
  gl_FragDepth = depth - height * reach;
  float light = 0.55 + 0.5 * max(0.0, dot(normal, normalize(vec3(-0.45, 0.6, 0.75))));
  vec3 lit = colourOfRod.rgb * mix(light, 1.0, 1.0 - colourOfRod.a);
  lit *= mix(1.0, 0.72, colourOfRod.a * smoothstep(0.72, 1.0, abs(across)));
  lit = mix(lit, paper, fog * smoothstep(fogRange.x, fogRange.y, depth));
  colour = vec4(lit, opacity);
}
`;

export const WALL_VERTEX = /* glsl */ `
precision highp float;
uniform mat4 viewMatrix, projectionMatrix;
in vec3 position;
in vec4 tint;
out vec4 colourOfWall;
void main() {
  gl_Position = projectionMatrix * viewMatrix * vec4(position, 1.0);
  colourOfWall = tint;
}
`;

export const WALL_FRAGMENT = /* glsl */ `
precision highp float;
in vec4 colourOfWall;
layout(location = 0) out vec4 colour;
void main() { colour = colourOfWall; }
`;

/** One picture onto another, times a factor: sums samples up, and shows their mean. */
export const COPY_FRAGMENT = /* glsl */ `
precision highp float;
uniform highp sampler2D picture;
uniform float factor;
in vec2 at;
layout(location = 0) out vec4 colour;
void main() { colour = texture(picture, at) * factor; }
`;
