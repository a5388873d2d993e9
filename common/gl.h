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
    X(ATTACHSHADER, AttachShader)                                                                  \
    X(BINDATTRIBLOCATION, BindAttribLocation)                                                      \
    X(BINDBUFFER, BindBuffer)                                                                      \
    X(BINDFRAMEBUFFER, BindFramebuffer)                                                            \
    X(BINDRENDERBUFFER, BindRenderbuffer)                                                          \
    X(BUFFERDATA, BufferData)                                                                      \
    X(CHECKFRAMEBUFFERSTATUS, CheckFramebufferStatus)                                              \
    X(CLEAR, Clear)                                                                                \
    X(CLEARCOLOR, ClearColor)                                                                      \
    X(COMPILESHADER, CompileShader)                                                                \
    X(CREATEPROGRAM, CreateProgram)                                                                \
    X(CREATESHADER, CreateShader)                                                                  \
    X(DELETEBUFFERS, DeleteBuffers)                                                                \
    X(DELETEFRAMEBUFFERS, DeleteFramebuffers)                                                      \
    X(DELETEPROGRAM, DeleteProgram)                                                                \
    X(DELETERENDERBUFFERS, DeleteRenderbuffers)                                                    \
    X(DELETESHADER, DeleteShader)                                                                  \
    X(DISABLE, Disable)                                                                            \
    X(DISABLEVERTEXATTRIBARRAY, DisableVertexAttribArray)                                          \
    X(DRAWARRAYS, DrawArrays)                                                                      \
    X(DRAWELEMENTS, DrawElements)                                                                  \
    X(ENABLE, Enable)                                                                              \
    X(ENABLEVERTEXATTRIBARRAY, EnableVertexAttribArray)                                            \
    X(FINISH, Finish)                                                                              \
    X(FRAMEBUFFERRENDERBUFFER, FramebufferRenderbuffer)                                            \
    X(FRONTFACE, FrontFace)                                                                        \
    X(GENBUFFERS, GenBuffers)                                                                      \
    X(GENFRAMEBUFFERS, GenFramebuffers)                                                            \
    X(GENRENDERBUFFERS, GenRenderbuffers)                                                          \
    X(GETACTIVEATTRIB, GetActiveAttrib)                                                            \
    X(GETACTIVEUNIFORM, GetActiveUniform)                                                          \
    X(GETATTRIBLOCATION, GetAttribLocation)                                                        \
    X(GETERROR, GetError)                                                                          \
    X(GETINTEGERV, GetIntegerv)                                                                    \
    X(GETPROGRAMINFOLOG, GetProgramInfoLog)                                                        \
    X(GETPROGRAMIV, GetProgramiv)                                                                  \
    X(GETSHADERINFOLOG, GetShaderInfoLog)                                                          \
    X(GETSHADERIV, GetShaderiv)                                                                    \
    X(GETSHADERPRECISIONFORMAT, GetShaderPrecisionFormat)                                          \
    X(GETSTRING, GetString)                                                                        \
    X(GETUNIFORMLOCATION, GetUniformLocation)                                                      \
    X(LINKPROGRAM, LinkProgram)                                                                    \
    X(PIXELSTOREI, PixelStorei)                                                                    \
    X(READPIXELS, ReadPixels)                                                                      \
    X(RENDERBUFFERSTORAGE, RenderbufferStorage)                                                    \
    X(SCISSOR, Scissor)                                                                            \
    X(SHADERSOURCE, ShaderSource)                                                                  \
    X(UNIFORM1FV, Uniform1fv)                                                                      \
    X(UNIFORM3FV, Uniform3fv)                                                                      \
    X(UNIFORM4FV, Uniform4fv)                                                                      \
    X(UNIFORMMATRIX4FV, UniformMatrix4fv)                                                          \
    X(USEPROGRAM, UseProgram)                                                                      \
    X(VERTEXATTRIB3FV, VertexAttrib3fv)                                                            \
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
