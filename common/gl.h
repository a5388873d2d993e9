/*
 * gl: the OpenGL ES 2 functions, under their own names, as pointers that are loaded through the
 * canvas that is current (gl_load, which canvas_open calls). Linking none of the GL libraries keeps
 * a program from calling one library's functions in another's context.
 *
 * Where a function is missing from the driver, gl_load fails and names it; those of the second list
 * come with OpenGL ES 3 or an extension and are NULL where there are none.
 */
#ifndef GL_H
#define GL_H

#include "message.h"

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
    X(COLORMASK, ColorMask)                                                                        \
    X(COMPILESHADER, CompileShader)                                                                \
    X(CREATEPROGRAM, CreateProgram)                                                                \
    X(CREATESHADER, CreateShader)                                                                  \
    X(DELETEBUFFERS, DeleteBuffers)                                                                \
    X(DELETEFRAMEBUFFERS, DeleteFramebuffers)                                                      \
    X(DELETEPROGRAM, DeleteProgram)                                                                \
    X(DELETERENDERBUFFERS, DeleteRenderbuffers)                                                    \
    X(DELETESHADER, DeleteShader)                                                                  \
    X(DELETETEXTURES, DeleteTextures)                                                              \
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
    X(GETINTEGERV, GetIntegerv)                                                                    \
    X(GETPROGRAMINFOLOG, GetProgramInfoLog)                                                        \
    X(GETPROGRAMIV, GetProgramiv)                                                                  \
    X(GETSHADERINFOLOG, GetShaderInfoLog)                                                          \
    X(GETSHADERIV, GetShaderiv)                                                                    \
    X(GETSHADERPRECISIONFORMAT, GetShaderPrecisionFormat)                                          \
    X(GETSTRING, GetString)                                                                        \
    X(GETUNIFORMLOCATION, GetUniformLocation)                                                      \
    X(GETVERTEXATTRIBFV, GetVertexAttribfv)                                                        \
    X(GETVERTEXATTRIBIV, GetVertexAttribiv)                                                        \
    X(GETVERTEXATTRIBPOINTERV, GetVertexAttribPointerv)                                            \
    X(ISENABLED, IsEnabled)                                                                        \
    X(LINKPROGRAM, LinkProgram)                                                                    \
    X(PIXELSTOREI, PixelStorei)                                                                    \
    X(READPIXELS, ReadPixels)                                                                      \
    X(RENDERBUFFERSTORAGE, RenderbufferStorage)                                                    \
    X(SCISSOR, Scissor)                                                                            \
    X(SHADERSOURCE, ShaderSource)                                                                  \
    X(TEXIMAGE2D, TexImage2D)                                                                      \
    X(TEXPARAMETERI, TexParameteri)                                                                \
    X(UNIFORM1FV, Uniform1fv)                                                                      \
    X(UNIFORM1I, Uniform1i)                                                                        \
    X(UNIFORM2FV, Uniform2fv)                                                                      \
    X(UNIFORM3FV, Uniform3fv)                                                                      \
    X(UNIFORM4FV, Uniform4fv)                                                                      \
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

/* Of GL_EXT_disjoint_timer_query; NULL where the context lacks it. */
#define GL_TIMER_FUNCTIONS(X)                                                                      \
    X(BEGINQUERY, BeginQuery)                                                                      \
    X(DELETEQUERIES, DeleteQueries)                                                                \
    X(ENDQUERY, EndQuery)                                                                          \
    X(GENQUERIES, GenQueries)                                                                      \
    X(GETQUERYIV, GetQueryiv)                                                                      \
    X(GETQUERYOBJECTUI64V, GetQueryObjectui64v)

/* Hidden, so that no driver that is loaded later can take these variables for its functions. */
#pragma GCC visibility push(hidden)
#define GL_DECLARE(TYPE, name) extern PFNGL##TYPE##PROC gl##name;
GL_FUNCTIONS(GL_DECLARE)
#undef GL_DECLARE
#define GL_DECLARE(TYPE, name) extern PFNGL##TYPE##EXTPROC gl##name##EXT;
GL_TIMER_FUNCTIONS(GL_DECLARE)
#undef GL_DECLARE
extern GlRenderbufferStorageMultisample glRenderbufferStorageMultisample;
extern GlBlitFramebuffer glBlitFramebuffer;
/* Of GL_EXT_robustness or GL_KHR_robustness; NULL where the context has neither. */
extern PFNGLGETGRAPHICSRESETSTATUSEXTPROC glGetGraphicsResetStatus;
#pragma GCC visibility pop

typedef void (*GlFunction)(void);

/* Loads every function through `address` (a backend's GetProcAddress); a context must be current.
 * False, naming the function, where the driver lacks one of OpenGL ES 2's. */
bool gl_load(GlFunction (*address)(const char *name), Message *message);

/* The context's version of OpenGL ES as 10 * major + minor: 20 for OpenGL ES 2.0. One of desktop
 * OpenGL 3.0 or more counts as 30: it has what is asked of that here, under the same names. */
int gl_version(void);

/* Whether the context is one of desktop OpenGL. */
bool gl_desktop(void);

/* Whether framebuffers can be of 32-bit floats. */
bool gl_draws_floats(void);

/* Whether the context lists the extension ("GL_OES_element_index_uint"). */
bool gl_has(const char *extension);

/* The name of a GL error code: "GL_INVALID_VALUE". */
const char *gl_error_name(GLenum error);

#endif
