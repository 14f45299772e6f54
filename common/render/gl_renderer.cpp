#include "common/render/gl_renderer.h"

#include <array>
#include <cstddef>

#include "common/base/check.h"

namespace swath {
namespace {

// Vertices are shaded by Lambert with the light at the eye, on both sides, because models from the world are
// not consistently wound. Only moving models have code and data for motion. Their positions are those of
// posed(), except where a driver fuses product and sum, which this version of GLSL cannot forbid.
constexpr const char* kVersion = "#version 330 core\n";
constexpr const char* kVertexShader = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 colour;
uniform mat4 clip_from_model;
uniform vec3 to_light;
#ifdef MOVES
layout(location = 3) in vec3 motion;
uniform float pose;
vec3 posed() { return position + pose * motion; }
#else
vec3 posed() { return position; }
#endif
out vec3 shaded;
void main() {
    gl_Position = clip_from_model * vec4(posed(), 1.0);
    shaded = colour.rgb * (0.2 + 0.8 * abs(dot(normal, to_light)));
}
)";

constexpr const char* kFragmentShader = R"(
in vec3 shaded;
uniform uint object;
layout(location = 0) out vec4 colour;
layout(location = 1) out uint id;
void main() {
    colour = vec4(shaded, 1.0);
    id = object;
}
)";

Result<std::unique_ptr<GlContext>> make_context(RendererKind kind) {
    return kind == RendererKind::kEgl ? make_egl_context() : make_osmesa_context();
}

std::string describe(const GlFunctions& gl) {
    const auto text = [&](GLenum name) { return reinterpret_cast<const char*>(gl.GetString(name)); };
    return fmt::format("{}, OpenGL {}", text(GL_RENDERER), text(GL_VERSION));
}

}  // namespace

GlRenderer::GlRenderer(std::unique_ptr<GlContext> context, const ObjectSet& scene, const GlFunctions& gl)
    : context_(std::move(context)), scene_(scene), gl_(gl) {}

Result<std::unique_ptr<Renderer>> GlRenderer::make(std::unique_ptr<GlContext> context,
                                                   const ObjectSet& scene) {
    SWATH_TRY(const GlFunctions gl, load_gl_functions(*context));
    std::unique_ptr<GlRenderer> renderer(new GlRenderer(std::move(context), scene, gl));
    SWATH_TRY_VOID(renderer->make_program());
    SWATH_TRY_VOID(renderer->upload());
    return renderer;
}

Status GlRenderer::check(const char* what) const {
    const GLenum error = gl_.GetError();
    if (error == GL_NO_ERROR) return {};
    if (error == GL_OUT_OF_MEMORY) return fail("OpenGL: out of memory while {}", what);
    return fail("OpenGL: error {:#x} while {}", error, what);
}

Status GlRenderer::make_program() {
    const GLuint program = gl_.CreateProgram();
    for (const auto& [kind, source] :
         {std::pair(GL_VERTEX_SHADER, kVertexShader), std::pair(GL_FRAGMENT_SHADER, kFragmentShader)}) {
        const GLuint shader = gl_.CreateShader(static_cast<GLenum>(kind));
        const std::array<const char*, 3> parts{kVersion, scene_.moves() ? "#define MOVES\n" : "", source};
        gl_.ShaderSource(shader, static_cast<GLsizei>(parts.size()), parts.data(), nullptr);
        gl_.CompileShader(shader);
        GLint ok = GL_FALSE;
        gl_.GetShaderiv(shader, GL_COMPILE_STATUS, &ok);
        if (ok != GL_TRUE) {
            std::array<char, 1024> log{};
            gl_.GetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), nullptr, log.data());
            return fail("OpenGL: a shader does not compile: {}", log.data());
        }
        gl_.AttachShader(program, shader);
        gl_.DeleteShader(shader);
    }
    gl_.LinkProgram(program);
    GLint ok = GL_FALSE;
    gl_.GetProgramiv(program, GL_LINK_STATUS, &ok);
    if (ok != GL_TRUE) {
        std::array<char, 1024> log{};
        gl_.GetProgramInfoLog(program, static_cast<GLsizei>(log.size()), nullptr, log.data());
        return fail("OpenGL: the shaders do not link: {}", log.data());
    }
    gl_.UseProgram(program);
    clip_from_model_ = gl_.GetUniformLocation(program, "clip_from_model");
    to_light_ = gl_.GetUniformLocation(program, "to_light");
    pose_ = gl_.GetUniformLocation(program, "pose");
    object_ = gl_.GetUniformLocation(program, "object");
    return {};
}

Status GlRenderer::upload() {
    GLuint array = 0;
    gl_.GenVertexArrays(1, &array);
    gl_.BindVertexArray(array);
    std::array<GLuint, 3> buffers{};
    gl_.GenBuffers(scene_.moves() ? 3 : 2, buffers.data());
    const Mesh& mesh = scene_.mesh;
    gl_.BindBuffer(GL_ARRAY_BUFFER, buffers[0]);
    gl_.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(mesh.vertices.size() * sizeof(Vertex)),
                   mesh.vertices.data(), GL_STATIC_DRAW);
    gl_.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers[1]);
    gl_.BufferData(GL_ELEMENT_ARRAY_BUFFER,
                   static_cast<GLsizeiptr>(mesh.indices.size() * sizeof(std::uint32_t)), mesh.indices.data(),
                   GL_STATIC_DRAW);
    const auto attribute = [&](GLuint at, GLint size, GLenum type, GLboolean normalised, std::size_t offset) {
        gl_.EnableVertexAttribArray(at);
        gl_.VertexAttribPointer(at, size, type, normalised, sizeof(Vertex),
                                reinterpret_cast<const void*>(offset));
    };
    attribute(0, 3, GL_FLOAT, GL_FALSE, offsetof(Vertex, position));
    attribute(1, 3, GL_SHORT, GL_TRUE, offsetof(Vertex, normal));
    attribute(2, 4, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(Vertex, colour));
    if (scene_.moves()) {
        gl_.BindBuffer(GL_ARRAY_BUFFER, buffers[2]);
        gl_.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(mesh.motion.size() * sizeof(glm::vec3)),
                       mesh.motion.data(), GL_STATIC_DRAW);
        gl_.EnableVertexAttribArray(3);
        gl_.VertexAttribPointer(3, 3, GL_FLOAT, GL_FALSE, 0, nullptr);
    }

    GLuint framebuffer = 0;
    gl_.GenFramebuffers(1, &framebuffer);
    gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    std::array<GLuint, 3> targets{};
    gl_.GenRenderbuffers(3, targets.data());
    colour_buffer_ = targets[0];
    id_buffer_ = targets[1];
    depth_buffer_ = targets[2];
    gl_.Enable(GL_DEPTH_TEST);
    gl_.DepthFunc(GL_LESS);
    gl_.Enable(GL_SCISSOR_TEST);
    gl_.PixelStorei(GL_PACK_ALIGNMENT, 4);
    return check("uploading the model");
}

Status GlRenderer::resize(int width, int height) {
    GLint limit = 0;
    gl_.GetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &limit);
    if (width < 1 || height < 1 || width > limit || height > limit)
        return fail("picture size {}x{}: this renderer's limits are 1x1 to {}x{}", width, height, limit,
                    limit);
    const auto storage = [&](GLuint buffer, GLenum format, GLenum attachment) {
        gl_.BindRenderbuffer(GL_RENDERBUFFER, buffer);
        gl_.RenderbufferStorage(GL_RENDERBUFFER, format, width, height);
        gl_.FramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, buffer);
    };
    storage(colour_buffer_, GL_RGBA8, GL_COLOR_ATTACHMENT0);
    storage(id_buffer_, GL_R32UI, GL_COLOR_ATTACHMENT1);
    storage(depth_buffer_, GL_DEPTH_COMPONENT32F, GL_DEPTH_ATTACHMENT);
    const std::array<GLenum, 2> targets{GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
    gl_.DrawBuffers(2, targets.data());
    if (gl_.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        return fail("OpenGL: no framebuffer of {}x{} with RGBA8, R32UI and 32-bit float depth", width,
                    height);
    gl_.Viewport(0, 0, width, height);
    width_ = width;
    height_ = height;
    return check("making the framebuffer");
}

Status GlRenderer::draw(std::span<const TriangleRange> ranges, const View& view, const Rect& rect) {
    drawn_ = {};
    if (view.width != width_ || view.height != height_) SWATH_TRY_VOID(resize(view.width, view.height));
    CHECK(view.viewport().contains(rect) == true);
    gl_.Scissor(rect.x0, rect.y0, rect.width(), rect.height());
    // Only depth is cleared, because nobody looks at the colour or id of a pixel with depth 1.
    const float far = kFarDepth;
    gl_.ClearBufferfv(GL_DEPTH, 0, &far);
    gl_.UniformMatrix4fv(clip_from_model_, 1, GL_FALSE, &view.clip_from_model[0][0]);
    gl_.Uniform3f(to_light_, view.to_light.x, view.to_light.y, view.to_light.z);
    if (scene_.moves()) gl_.Uniform1f(pose_, view.pose);
    for (std::size_t begin = 0; begin < ranges.size();) {
        std::size_t end = begin + 1;
        while (end < ranges.size() && ranges[end].object == ranges[begin].object) ++end;
        draw_object(ranges.subspan(begin, end - begin));
        begin = end;
    }
    gl_.Finish();
    drawn_ = rect;
    return check("drawing");
}

// Draws ranges of one object, which share its id, in one call.
void GlRenderer::draw_object(std::span<const TriangleRange> ranges) {
    const ObjectId id = ranges.front().object;
    CHECK(id < scene_.objects.size());
    const Object& object = scene_.objects[id];
    counts_.clear();
    positions_.clear();
    for (const TriangleRange& range : ranges) {
        CHECK(range.first_triangle >= object.first_triangle);
        CHECK(range.first_triangle + range.triangle_count <= object.first_triangle + object.triangle_count);
        counts_.push_back(static_cast<GLsizei>(3 * range.triangle_count));
        positions_.push_back(
            reinterpret_cast<const void*>(std::size_t{3} * sizeof(std::uint32_t) * range.first_triangle));
    }
    gl_.Uniform1ui(object_, id);
    if (ranges.size() == 1)
        gl_.DrawElements(GL_TRIANGLES, counts_[0], GL_UNSIGNED_INT, positions_[0]);
    else
        gl_.MultiDrawElements(GL_TRIANGLES, counts_.data(), GL_UNSIGNED_INT, positions_.data(),
                              static_cast<GLsizei>(ranges.size()));
}

Status GlRenderer::read(const Rect& rect, PixelFrame& frame) {
    if (rect.empty()) return {};
    CHECK(frame.rect().contains(rect) == true);
    CHECK(drawn_.contains(rect) == true);
    gl_.PixelStorei(GL_PACK_ROW_LENGTH, frame.rect().width());
    const auto pixels = [&](GLenum format, GLenum type, void* to) {
        gl_.ReadPixels(rect.x0, rect.y0, rect.width(), rect.height(), format, type, to);
    };
    pixels(GL_DEPTH_COMPONENT, GL_FLOAT, frame.depth(rect.x0, rect.y0));
    gl_.ReadBuffer(GL_COLOR_ATTACHMENT0);
    pixels(GL_RGBA, GL_UNSIGNED_BYTE, frame.colour(rect.x0, rect.y0));
    gl_.ReadBuffer(GL_COLOR_ATTACHMENT1);
    pixels(GL_RED_INTEGER, GL_UNSIGNED_INT, frame.id(rect.x0, rect.y0));
    return check("reading pixels");
}

std::string GlRenderer::description() const { return describe(gl_); }

Result<std::unique_ptr<Renderer>> make_gl_renderer(RendererKind kind, const ObjectSet& scene) {
    SWATH_TRY(auto context, make_context(kind));
    return GlRenderer::make(std::move(context), scene);
}

Result<std::string> try_gl(RendererKind kind) {
    SWATH_TRY(const auto context, make_context(kind));
    SWATH_TRY(const GlFunctions gl, load_gl_functions(*context));
    return describe(gl);
}

}  // namespace swath
