// What the key light's map keeps is the depth alone; a mask has holes there too.
#ifdef MASKED
#include "material.glsl"

void main() {
  if (base_colour().a < material.roughness_cutoff_normal_occlusion.y) discard;
}
#else
void main() {}
#endif
