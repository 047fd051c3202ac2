/* OpenGL's functions, by a table of the context's own: none is linked, and two contexts may have different ones.
 *
 * A function is called as gl->api.Name(...). Needed is what OpenGL 4.3 has; what later versions or extensions
 * bring is optional, and NULL where it is absent. To use another function, add its name here. */
#ifndef DP_GL_API_H
#define DP_GL_API_H

#include <GL/glcorearb.h>

#include <drypoint/gl.h>

/* X(name, type of the pointer) */
#define DP_GL_NEEDED(X)                                                                            \
    X(ActiveTexture, PFNGLACTIVETEXTUREPROC)                                                       \
    X(AttachShader, PFNGLATTACHSHADERPROC)                                                         \
    X(BeginQuery, PFNGLBEGINQUERYPROC)                                                             \
    X(BindBuffer, PFNGLBINDBUFFERPROC)                                                             \
    X(BindBufferBase, PFNGLBINDBUFFERBASEPROC)                                                     \
    X(BindBufferRange, PFNGLBINDBUFFERRANGEPROC)                                                   \
    X(BindFramebuffer, PFNGLBINDFRAMEBUFFERPROC)                                                   \
    X(BindImageTexture, PFNGLBINDIMAGETEXTUREPROC)                                                 \
    X(BindSampler, PFNGLBINDSAMPLERPROC)                                                           \
    X(BindTexture, PFNGLBINDTEXTUREPROC)                                                           \
    X(BindVertexArray, PFNGLBINDVERTEXARRAYPROC)                                                   \
    X(BlendEquation, PFNGLBLENDEQUATIONPROC)                                                       \
    X(BlendEquationSeparate, PFNGLBLENDEQUATIONSEPARATEPROC)                                       \
    X(BlendFunc, PFNGLBLENDFUNCPROC)                                                               \
    X(BlendFuncSeparate, PFNGLBLENDFUNCSEPARATEPROC)                                               \
    X(BlendFuncSeparatei, PFNGLBLENDFUNCSEPARATEIPROC)                                             \
    X(BlendEquationSeparatei, PFNGLBLENDEQUATIONSEPARATEIPROC)                                     \
    X(BlitFramebuffer, PFNGLBLITFRAMEBUFFERPROC)                                                   \
    X(BufferData, PFNGLBUFFERDATAPROC)                                                             \
    X(BufferSubData, PFNGLBUFFERSUBDATAPROC)                                                       \
    X(CheckFramebufferStatus, PFNGLCHECKFRAMEBUFFERSTATUSPROC)                                     \
    X(ClearBufferData, PFNGLCLEARBUFFERDATAPROC)                                                   \
    X(ClearBufferSubData, PFNGLCLEARBUFFERSUBDATAPROC)                                             \
    X(ClearBufferfv, PFNGLCLEARBUFFERFVPROC)                                                       \
    X(ClearBufferfi, PFNGLCLEARBUFFERFIPROC)                                                       \
    X(ClearBufferuiv, PFNGLCLEARBUFFERUIVPROC)                                                     \
    X(ColorMask, PFNGLCOLORMASKPROC)                                                               \
    X(ColorMaski, PFNGLCOLORMASKIPROC)                                                             \
    X(CompileShader, PFNGLCOMPILESHADERPROC)                                                       \
    X(CopyBufferSubData, PFNGLCOPYBUFFERSUBDATAPROC)                                               \
    X(CreateProgram, PFNGLCREATEPROGRAMPROC)                                                       \
    X(CreateShader, PFNGLCREATESHADERPROC)                                                         \
    X(CullFace, PFNGLCULLFACEPROC)                                                                 \
    X(DebugMessageCallback, PFNGLDEBUGMESSAGECALLBACKPROC)                                         \
    X(DebugMessageControl, PFNGLDEBUGMESSAGECONTROLPROC)                                           \
    X(DeleteBuffers, PFNGLDELETEBUFFERSPROC)                                                       \
    X(DeleteFramebuffers, PFNGLDELETEFRAMEBUFFERSPROC)                                             \
    X(DeleteProgram, PFNGLDELETEPROGRAMPROC)                                                       \
    X(DeleteQueries, PFNGLDELETEQUERIESPROC)                                                       \
    X(DeleteSamplers, PFNGLDELETESAMPLERSPROC)                                                     \
    X(DeleteShader, PFNGLDELETESHADERPROC)                                                         \
    X(DeleteTextures, PFNGLDELETETEXTURESPROC)                                                     \
    X(DeleteVertexArrays, PFNGLDELETEVERTEXARRAYSPROC)                                             \
    X(DepthFunc, PFNGLDEPTHFUNCPROC)                                                               \
    X(DepthMask, PFNGLDEPTHMASKPROC)                                                               \
    X(DepthRangef, PFNGLDEPTHRANGEFPROC)                                                           \
    X(DepthRangeIndexed, PFNGLDEPTHRANGEINDEXEDPROC)                                               \
    X(DetachShader, PFNGLDETACHSHADERPROC)                                                         \
    X(Disable, PFNGLDISABLEPROC)                                                                   \
    X(DisableVertexAttribArray, PFNGLDISABLEVERTEXATTRIBARRAYPROC)                                 \
    X(Disablei, PFNGLDISABLEIPROC)                                                                 \
    X(DispatchCompute, PFNGLDISPATCHCOMPUTEPROC)                                                   \
    X(DispatchComputeIndirect, PFNGLDISPATCHCOMPUTEINDIRECTPROC)                                   \
    X(DrawArrays, PFNGLDRAWARRAYSPROC)                                                             \
    X(DrawArraysIndirect, PFNGLDRAWARRAYSINDIRECTPROC)                                             \
    X(DrawArraysInstanced, PFNGLDRAWARRAYSINSTANCEDPROC)                                           \
    X(DrawBuffer, PFNGLDRAWBUFFERPROC)                                                             \
    X(DrawBuffers, PFNGLDRAWBUFFERSPROC)                                                           \
    X(DrawElements, PFNGLDRAWELEMENTSPROC)                                                         \
    X(Enable, PFNGLENABLEPROC)                                                                     \
    X(EnableVertexAttribArray, PFNGLENABLEVERTEXATTRIBARRAYPROC)                                   \
    X(Enablei, PFNGLENABLEIPROC)                                                                   \
    X(EndQuery, PFNGLENDQUERYPROC)                                                                 \
    X(Finish, PFNGLFINISHPROC)                                                                     \
    X(Flush, PFNGLFLUSHPROC)                                                                       \
    X(FramebufferTexture, PFNGLFRAMEBUFFERTEXTUREPROC)                                             \
    X(FramebufferTextureLayer, PFNGLFRAMEBUFFERTEXTURELAYERPROC)                                   \
    X(FrontFace, PFNGLFRONTFACEPROC)                                                               \
    X(GenBuffers, PFNGLGENBUFFERSPROC)                                                             \
    X(GenFramebuffers, PFNGLGENFRAMEBUFFERSPROC)                                                   \
    X(GenQueries, PFNGLGENQUERIESPROC)                                                             \
    X(GenSamplers, PFNGLGENSAMPLERSPROC)                                                           \
    X(GenTextures, PFNGLGENTEXTURESPROC)                                                           \
    X(GenVertexArrays, PFNGLGENVERTEXARRAYSPROC)                                                   \
    X(GenerateMipmap, PFNGLGENERATEMIPMAPPROC)                                                     \
    X(GetBooleani_v, PFNGLGETBOOLEANI_VPROC)                                                       \
    X(GetBooleanv, PFNGLGETBOOLEANVPROC)                                                           \
    X(GetBufferParameteri64v, PFNGLGETBUFFERPARAMETERI64VPROC)                                     \
    X(GetBufferSubData, PFNGLGETBUFFERSUBDATAPROC)                                                 \
    X(GetDoublei_v, PFNGLGETDOUBLEI_VPROC)                                                         \
    X(GetDoublev, PFNGLGETDOUBLEVPROC)                                                             \
    X(GetError, PFNGLGETERRORPROC)                                                                 \
    X(GetFloati_v, PFNGLGETFLOATI_VPROC)                                                           \
    X(GetFloatv, PFNGLGETFLOATVPROC)                                                               \
    X(GetFramebufferAttachmentParameteriv, PFNGLGETFRAMEBUFFERATTACHMENTPARAMETERIVPROC)           \
    X(GetInteger64i_v, PFNGLGETINTEGER64I_VPROC)                                                   \
    X(GetInteger64v, PFNGLGETINTEGER64VPROC)                                                       \
    X(GetIntegeri_v, PFNGLGETINTEGERI_VPROC)                                                       \
    X(GetIntegerv, PFNGLGETINTEGERVPROC)                                                           \
    X(GetMultisamplefv, PFNGLGETMULTISAMPLEFVPROC)                                                 \
    X(GetPointerv, PFNGLGETPOINTERVPROC)                                                           \
    X(GetProgramInfoLog, PFNGLGETPROGRAMINFOLOGPROC)                                               \
    X(GetProgramiv, PFNGLGETPROGRAMIVPROC)                                                         \
    X(GetQueryObjectui64v, PFNGLGETQUERYOBJECTUI64VPROC)                                           \
    X(GetQueryObjectuiv, PFNGLGETQUERYOBJECTUIVPROC)                                               \
    X(GetShaderInfoLog, PFNGLGETSHADERINFOLOGPROC)                                                 \
    X(GetShaderiv, PFNGLGETSHADERIVPROC)                                                           \
    X(GetString, PFNGLGETSTRINGPROC)                                                               \
    X(GetStringi, PFNGLGETSTRINGIPROC)                                                             \
    X(GetTexLevelParameteriv, PFNGLGETTEXLEVELPARAMETERIVPROC)                                     \
    X(GetTexParameteriv, PFNGLGETTEXPARAMETERIVPROC)                                               \
    X(GetUniformLocation, PFNGLGETUNIFORMLOCATIONPROC)                                             \
    X(IsEnabled, PFNGLISENABLEDPROC)                                                               \
    X(IsEnabledi, PFNGLISENABLEDIPROC)                                                             \
    X(IsFramebuffer, PFNGLISFRAMEBUFFERPROC)                                                       \
    X(LineWidth, PFNGLLINEWIDTHPROC)                                                               \
    X(LinkProgram, PFNGLLINKPROGRAMPROC)                                                           \
    X(LogicOp, PFNGLLOGICOPPROC)                                                                   \
    X(MapBufferRange, PFNGLMAPBUFFERRANGEPROC)                                                     \
    X(MemoryBarrier, PFNGLMEMORYBARRIERPROC)                                                       \
    X(MinSampleShading, PFNGLMINSAMPLESHADINGPROC)                                                 \
    X(PatchParameteri, PFNGLPATCHPARAMETERIPROC)                                                   \
    X(PixelStorei, PFNGLPIXELSTOREIPROC)                                                           \
    X(PolygonMode, PFNGLPOLYGONMODEPROC)                                                           \
    X(PolygonOffset, PFNGLPOLYGONOFFSETPROC)                                                       \
    X(PrimitiveRestartIndex, PFNGLPRIMITIVERESTARTINDEXPROC)                                       \
    X(ProvokingVertex, PFNGLPROVOKINGVERTEXPROC)                                                   \
    X(QueryCounter, PFNGLQUERYCOUNTERPROC)                                                         \
    X(ReadBuffer, PFNGLREADBUFFERPROC)                                                             \
    X(ReadPixels, PFNGLREADPIXELSPROC)                                                             \
    X(SampleCoverage, PFNGLSAMPLECOVERAGEPROC)                                                     \
    X(SampleMaski, PFNGLSAMPLEMASKIPROC)                                                           \
    X(SamplerParameteri, PFNGLSAMPLERPARAMETERIPROC)                                               \
    X(SamplerParameterf, PFNGLSAMPLERPARAMETERFPROC)                                               \
    X(Scissor, PFNGLSCISSORPROC)                                                                   \
    X(ShaderSource, PFNGLSHADERSOURCEPROC)                                                         \
    X(StencilFuncSeparate, PFNGLSTENCILFUNCSEPARATEPROC)                                           \
    X(StencilMaskSeparate, PFNGLSTENCILMASKSEPARATEPROC)                                           \
    X(StencilOpSeparate, PFNGLSTENCILOPSEPARATEPROC)                                               \
    X(TexBuffer, PFNGLTEXBUFFERPROC)                                                               \
    X(TexImage2D, PFNGLTEXIMAGE2DPROC)                                                             \
    X(TexParameteri, PFNGLTEXPARAMETERIPROC)                                                       \
    X(TexParameterf, PFNGLTEXPARAMETERFPROC)                                                       \
    X(TexStorage2D, PFNGLTEXSTORAGE2DPROC)                                                         \
    X(TexStorage2DMultisample, PFNGLTEXSTORAGE2DMULTISAMPLEPROC)                                   \
    X(TexStorage3DMultisample, PFNGLTEXSTORAGE3DMULTISAMPLEPROC)                                   \
    X(TexStorage3D, PFNGLTEXSTORAGE3DPROC)                                                         \
    X(TexSubImage2D, PFNGLTEXSUBIMAGE2DPROC)                                                       \
    X(TexSubImage3D, PFNGLTEXSUBIMAGE3DPROC)                                                       \
    X(Uniform1f, PFNGLUNIFORM1FPROC)                                                               \
    X(Uniform1i, PFNGLUNIFORM1IPROC)                                                               \
    X(Uniform1ui, PFNGLUNIFORM1UIPROC)                                                             \
    X(Uniform2f, PFNGLUNIFORM2FPROC)                                                               \
    X(Uniform2i, PFNGLUNIFORM2IPROC)                                                               \
    X(Uniform2ui, PFNGLUNIFORM2UIPROC)                                                             \
    X(Uniform3f, PFNGLUNIFORM3FPROC)                                                               \
    X(Uniform4f, PFNGLUNIFORM4FPROC)                                                               \
    X(Uniform4fv, PFNGLUNIFORM4FVPROC)                                                             \
    X(Uniform4i, PFNGLUNIFORM4IPROC)                                                               \
    X(Uniform4ui, PFNGLUNIFORM4UIPROC)                                                             \
    X(UnmapBuffer, PFNGLUNMAPBUFFERPROC)                                                           \
    X(UseProgram, PFNGLUSEPROGRAMPROC)                                                             \
    X(VertexAttribIPointer, PFNGLVERTEXATTRIBIPOINTERPROC)                                         \
    X(VertexAttribPointer, PFNGLVERTEXATTRIBPOINTERPROC)                                           \
    X(VertexAttribDivisor, PFNGLVERTEXATTRIBDIVISORPROC)                                           \
    X(Viewport, PFNGLVIEWPORTPROC)                                                                 \
    X(ViewportIndexedf, PFNGLVIEWPORTINDEXEDFPROC)                                                 \
    X(GetTexImage, PFNGLGETTEXIMAGEPROC)                                                           \
    X(IsTexture, PFNGLISTEXTUREPROC)                                                               \
    X(IsBuffer, PFNGLISBUFFERPROC)                                                                 \
    X(InvalidateBufferData, PFNGLINVALIDATEBUFFERDATAPROC)                                         \
    X(TextureView, PFNGLTEXTUREVIEWPROC)                                                           \
    X(TexStorage1D, PFNGLTEXSTORAGE1DPROC)

#define DP_GL_OPTIONAL(X)                                                                          \
    X(ClearTexImage, PFNGLCLEARTEXIMAGEPROC)                                                       \
    X(ClipControl, PFNGLCLIPCONTROLPROC)                                                           \
    X(GetGraphicsResetStatus, PFNGLGETGRAPHICSRESETSTATUSPROC)

typedef struct dp_gl_api {
#define DP_GL_MEMBER(name, type) type name;
    DP_GL_NEEDED(DP_GL_MEMBER)
    DP_GL_OPTIONAL(DP_GL_MEMBER)
#undef DP_GL_MEMBER
} dp_gl_api;

/* DP_ERR_UNSUPPORTED names the first function that is missing. */
dp_result dp_gl_api_load(dp_gl_api *api, const dp_gl_desc *desc, dp_diag *diag);

#endif
