// Four independent clouds of noise that repeat after one unit.

layout(location = 0) out vec4 clouds;

void main() {
  vec2 uv = gl_FragCoord.xy / 512.0;
  clouds =
      vec4(cloud(uv, 4, 7, 800), cloud(uv, 5, 7, 810), cloud(uv, 6, 7, 820), cloud(uv, 7, 7, 830));
}
