/*
 * gl: the OpenGL ES 2 functions under their own names, as pointers that canvas_open loads. No GL
 * library is linked, so a program cannot call one library's functions in another's context.
 */
#ifndef GL_H
#define GL_H

#include "base/message.h"

#define GL_GLES_PROTOTYPES 0
#include <GLES2/gl2.h>
#include <GLES2/gl2ext.h>

#define GL_FUNCTIONS(X)                                                                            \
    X(ACTIVETEXTURE, ActiveTexture)                                                                \
    X(ATTACHSHADER, AttachShader)                                                                  \
    X(BINDATTRIBLOCATION, BindAttribLocation)                                                      \
    X(BINDBUFFER, BindBuffer)                                                                      \
    X(BINDFRAMEBUFFER, BindFramebuffer)                                                            \
    X(BINDRENDERBUFFER, BindRenderbuffer)                                                          \
    X(BINDTEXTURE, BindTexture)                                                                    \
    X(BLENDEQUATIONSEPARATE, BlendEquationSeparate)                                                \
    X(BLENDFUNCSEPARATE, BlendFuncSeparate)                                                        \
    X(BUFFERDATA, BufferData)                                                                      \
    X(BUFFERSUBDATA, BufferSubData)                                                                \
    X(CHECKFRAMEBUFFERSTATUS, CheckFramebufferStatus)                                              \
    X(CLEAR, Clear)                                                                                \
    X(CLEARCOLOR, ClearColor)                                                                      \
    X(CLEARSTENCIL, ClearStencil)                                                                  \
    X(COLORMASK, ColorMask)                                                                        \
    X(COMPILESHADER, CompileShader)                                                                \
    X(CREATEPROGRAM, CreateProgram)                                                                \
    X(CREATESHADER, CreateShader)                                                                  \
    X(CULLFACE, CullFace)                                                                          \
    X(DELETEBUFFERS, DeleteBuffers)                                                                \
    X(DELETEFRAMEBUFFERS, DeleteFramebuffers)                                                      \
    X(DELETEPROGRAM, DeleteProgram)                                                                \
    X(DELETERENDERBUFFERS, DeleteRenderbuffers)                                                    \
    X(DELETESHADER, DeleteShader)                                                                  \
    X(DELETETEXTURES, DeleteTextures)                                                              \
    X(DEPTHFUNC, DepthFunc)                                                                        \
    X(DEPTHMASK, DepthMask)                                                                        \
    X(DISABLE, Disable)                                                                            \
    X(DISABLEVERTEXATTRIBARRAY, DisableVertexAttribArray)                                          \
    X(DRAWARRAYS, DrawArrays)                                                                      \
    X(DRAWELEMENTS, DrawElements)                                                                  \
    X(ENABLE, Enable)                                                                              \
    X(ENABLEVERTEXATTRIBARRAY, EnableVertexAttribArray)                                            \
    X(FINISH, Finish)                                                                              \
    X(FRAMEBUFFERRENDERBUFFER, FramebufferRenderbuffer)                                            \
    X(FRAMEBUFFERTEXTURE2D, FramebufferTexture2D)                                                  \
    X(FRONTFACE, FrontFace)                                                                        \
    X(GENBUFFERS, GenBuffers)                                                                      \
    X(GENFRAMEBUFFERS, GenFramebuffers)                                                            \
    X(GENRENDERBUFFERS, GenRenderbuffers)                                                          \
    X(GENTEXTURES, GenTextures)                                                                    \
    X(GETACTIVEATTRIB, GetActiveAttrib)                                                            \
    X(GETACTIVEUNIFORM, GetActiveUniform)                                                          \
    X(GETATTRIBLOCATION, GetAttribLocation)                                                        \
    X(GETBOOLEANV, GetBooleanv)                                                                    \
    X(GETERROR, GetError)                                                                          \
    X(GETFLOATV, GetFloatv)                                                                        \
    X(GETINTEGERV, GetIntegerv)                                                                    \
    X(GETPROGRAMINFOLOG, GetProgramInfoLog)                                                        \
    X(GETPROGRAMIV, GetProgramiv)                                                                  \
    X(GETATTACHEDSHADERS, GetAttachedShaders)                                                      \
    X(GETSHADERINFOLOG, GetShaderInfoLog)                                                          \
    X(GETSHADERIV, GetShaderiv)                                                                    \
    X(GETSHADERPRECISIONFORMAT, GetShaderPrecisionFormat)                                          \
    X(GETSHADERSOURCE, GetShaderSource)                                                            \
    X(GETSTRING, GetString)                                                                        \
    X(GETTEXPARAMETERIV, GetTexParameteriv)                                                        \
    X(GETUNIFORMFV, GetUniformfv)                                                                  \
    X(GETUNIFORMLOCATION, GetUniformLocation)                                                      \
    X(GETVERTEXATTRIBFV, GetVertexAttribfv)                                                        \
    X(GETVERTEXATTRIBIV, GetVertexAttribiv)                                                        \
    X(GETVERTEXATTRIBPOINTERV, GetVertexAttribPointerv)                                            \
    X(ISENABLED, IsEnabled)                                                                        \
    X(LINEWIDTH, LineWidth)                                                                        \
    X(LINKPROGRAM, LinkProgram)                                                                    \
    X(PIXELSTOREI, PixelStorei)                                                                    \
    X(POLYGONOFFSET, PolygonOffset)                                                                \
    X(READPIXELS, ReadPixels)                                                                      \
    X(RENDERBUFFERSTORAGE, RenderbufferStorage)                                                    \
    X(SCISSOR, Scissor)                                                                            \
    X(SHADERSOURCE, ShaderSource)                                                                  \
    X(STENCILFUNC, StencilFunc)                                                                    \
    X(STENCILOPSEPARATE, StencilOpSeparate)                                                        \
    X(TEXIMAGE2D, TexImage2D)                                                                      \
    X(TEXPARAMETERI, TexParameteri)                                                                \
    X(UNIFORM1FV, Uniform1fv)                                                                      \
    X(UNIFORM1I, Uniform1i)                                                                        \
    X(UNIFORM2FV, Uniform2fv)                                                                      \
    X(UNIFORM2IV, Uniform2iv)                                                                      \
    X(UNIFORM3FV, Uniform3fv)                                                                      \
    X(UNIFORM3IV, Uniform3iv)                                                                      \
    X(UNIFORM4FV, Uniform4fv)                                                                      \
    X(UNIFORM4IV, Uniform4iv)                                                                      \
    X(UNIFORMMATRIX2FV, UniformMatrix2fv)                                                          \
    X(UNIFORMMATRIX3FV, UniformMatrix3fv)                                                          \
    X(UNIFORMMATRIX4FV, UniformMatrix4fv)                                                          \
    X(USEPROGRAM, UseProgram)                                                                      \
    X(VERTEXATTRIB3FV, VertexAttrib3fv)                                                            \
    X(VERTEXATTRIB4FV, VertexAttrib4fv)                                                            \
    X(VERTEXATTRIBPOINTER, VertexAttribPointer)                                                    \
    X(VIEWPORT, Viewport)

typedef void(GL_APIENTRYP GlRenderbufferStorageMultisample)(GLenum, GLsizei, GLenum, GLsizei,
                                                            GLsizei);
typedef void(GL_APIENTRYP GlBlitFramebuffer)(GLint, GLint, GLint, GLint, GLint, GLint, GLint, GLint,
                                             GLbitfield, GLenum);

/* Of GL_EXT_disjoint_timer_query; NULL without it. */
#define GL_TIMER_FUNCTIONS(X)                                                                      \
    X(BEGINQUERY, BeginQuery)                                                                      \
    X(DELETEQUERIES, DeleteQueries)                                                                \
    X(ENDQUERY, EndQuery)                                                                          \
    X(GENQUERIES, GenQueries)                                                                      \
    X(GETQUERYIV, GetQueryiv)                                                                      \
    X(GETQUERYOBJECTUI64V, GetQueryObjectui64v)

/* Of GL_OES_get_program_binary; NULL without it. */
#define GL_BINARY_FUNCTIONS(X)                                                                     \
    X(GETPROGRAMBINARY, GetProgramBinary)                                                          \
    X(PROGRAMBINARY, ProgramBinary)

/* Linked under other names, so that a driver loaded later cannot resolve its functions to these
 * variables. */
#define GL_LINKED(TYPE, name) extern TYPE gl##name __asm__("lighting_gl" #name);
#define GL_DECLARE(TYPE, name) GL_LINKED(PFNGL##TYPE##PROC, name)
GL_FUNCTIONS(GL_DECLARE)
#undef GL_DECLARE
#define GL_DECLARE(TYPE, name) GL_LINKED(PFNGL##TYPE##EXTPROC, name##EXT)
GL_TIMER_FUNCTIONS(GL_DECLARE)
#undef GL_DECLARE
#define GL_DECLARE(TYPE, name) GL_LINKED(PFNGL##TYPE##OESPROC, name##OES)
GL_BINARY_FUNCTIONS(GL_DECLARE)
#undef GL_DECLARE
/* Of OpenGL ES 3 or an extension; NULL without them. */
GL_LINKED(GlRenderbufferStorageMultisample, RenderbufferStorageMultisample)
GL_LINKED(GlBlitFramebuffer, BlitFramebuffer)
/* Of GL_EXT_robustness or GL_KHR_robustness; NULL without either. */
GL_LINKED(PFNGLGETGRAPHICSRESETSTATUSEXTPROC, GetGraphicsResetStatus)

typedef void (*GlFunction)(void);

/* Loads all functions through `address` (a backend's GetProcAddress); a context must be current.
 * False, naming the function, if the driver lacks one of OpenGL ES 2. */
bool gl_load(GlFunction (*address)(const char *name), Message *message);

/* The same for a backend's probe: appends a line, what draws or why nothing does. */
bool gl_probe(GlFunction (*address)(const char *name), Message *findings);

/* The version of OpenGL ES as 10 * major + minor: 20 for OpenGL ES 2.0. Desktop OpenGL 3.0 or later
 * counts as 30: it has what this project uses of OpenGL ES 3, under the same names. */
int gl_version(void);
bool gl_desktop(void);      /* whether the context is desktop OpenGL */
bool gl_draws_floats(void); /* whether framebuffers can have 32-bit float colours */

/* Whether a list of names separated by spaces (may be NULL) has this one; whether the context has
 * the extension ("GL_OES_element_index_uint"). */
bool gl_lists(const char *names, const char *name);
bool gl_has(const char *extension);
const char *gl_error_name(GLenum error); /* "GL_INVALID_VALUE" */

/* Whether a renderer of this name computes on the processor. */
bool gl_is_software(const char *renderer);

#endif
