#include "talus/render/headless_context.h"

#include <epoxy/egl.h>
#include <epoxy/gl.h>

#include <array>

#include "talus/base/error.h"

namespace talus {

struct HeadlessContext::Impl {
  EGLDisplay display = EGL_NO_DISPLAY;
  EGLContext context = EGL_NO_CONTEXT;
};

namespace {

Error no_opengl(const std::string& what) {
  return job_error("no OpenGL without a display: " + what +
                   "; install EGL and Mesa (Debian: libegl1 libgl1 libgl1-mesa-dri)");
}

EGLDisplay surfaceless_display() {
  // epoxy aborts on a function that is not there, so ask before each call.
  if (!epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_EXT_platform_base") ||
      !epoxy_has_egl_extension(EGL_NO_DISPLAY, "EGL_MESA_platform_surfaceless"))
    throw no_opengl("EGL has no surfaceless platform");
  const EGLDisplay display =
      eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr))
    throw no_opengl("EGL does not start");
  return display;
}

}  // namespace

HeadlessContext::HeadlessContext() : impl_(std::make_unique<Impl>()) {
  if (!epoxy_has_egl()) throw no_opengl("libEGL is missing");
  // The display is shared by the process and stays initialised: terminating it would pull it from
  // under other contexts.
  impl_->display = surfaceless_display();
  if (!epoxy_has_egl_extension(impl_->display, "EGL_KHR_no_config_context") ||
      !epoxy_has_egl_extension(impl_->display, "EGL_KHR_surfaceless_context"))
    throw no_opengl("EGL cannot make a context without a surface");
  if (!eglBindAPI(EGL_OPENGL_API)) throw no_opengl("EGL offers no desktop OpenGL");
  constexpr std::array<EGLint, 9> kAttributes = {EGL_CONTEXT_MAJOR_VERSION,
                                                 4,
                                                 EGL_CONTEXT_MINOR_VERSION,
                                                 5,
                                                 EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                                 EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                                 EGL_CONTEXT_OPENGL_DEBUG,
                                                 EGL_TRUE,
                                                 EGL_NONE};
  impl_->context =
      eglCreateContext(impl_->display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, kAttributes.data());
  if (impl_->context == EGL_NO_CONTEXT) throw no_opengl("the driver has no OpenGL 4.5 core");
  if (!eglMakeCurrent(impl_->display, EGL_NO_SURFACE, EGL_NO_SURFACE, impl_->context)) {
    eglDestroyContext(impl_->display, impl_->context);
    throw no_opengl("the context cannot be made current");
  }
}

HeadlessContext::~HeadlessContext() {
  if (eglGetCurrentContext() == impl_->context)
    eglMakeCurrent(impl_->display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(impl_->display, impl_->context);
}

std::string HeadlessContext::version() const {
  return reinterpret_cast<const char*>(glGetString(GL_VERSION));
}

int HeadlessContext::version_number() const { return epoxy_gl_version(); }

}  // namespace talus
