// The depth of faces, into another depth buffer.
#if SAMPLES > 1
uniform sampler2DMS depths;
#define AT gl_SampleID
#else
uniform sampler2D depths;
#define AT 0
#endif
void main() { gl_FragDepth = texelFetch(depths, ivec2(gl_FragCoord.xy), AT).x; }
