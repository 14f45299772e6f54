#include "common/scene/assimp_model.h"

#include <assimp/config.h>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <exception>
#include <functional>
#include <optional>
#include <vector>

namespace swath {
namespace {

// GenSmoothNormals leaves meshes alone that have normals. Vertices are joined if all of their components are
// equal, so components that we do not use are removed first. SortByPType splits off points and lines, which
// are then removed.
constexpr unsigned int kSteps = aiProcess_Triangulate | aiProcess_JoinIdenticalVertices |
                                aiProcess_GenSmoothNormals | aiProcess_SortByPType |
                                aiProcess_RemoveComponent;
constexpr int kUnusedPrimitives = aiPrimitiveType_POINT | aiPrimitiveType_LINE;
constexpr int kUnusedComponents = aiComponent_TEXCOORDS | aiComponent_TANGENTS_AND_BITANGENTS |
                                  aiComponent_BONEWEIGHTS | aiComponent_ANIMATIONS | aiComponent_TEXTURES |
                                  aiComponent_LIGHTS | aiComponent_CAMERAS;

using Colour = std::array<std::uint8_t, 4>;

std::uint8_t colour_byte(float value) {
    if (!(value > 0)) return 0;  // also if it is NaN
    return value >= 1 ? std::uint8_t{255} : static_cast<std::uint8_t>(value * 255.0f + 0.5f);
}

Colour colour_of(const aiColor4D& c) {
    return {colour_byte(c.r), colour_byte(c.g), colour_byte(c.b), colour_byte(c.a)};
}

Colour colour_of(const aiMaterial& material) {
    aiColor4D colour;
    if (material.Get(AI_MATKEY_BASE_COLOR, colour) == aiReturn_SUCCESS ||
        material.Get(AI_MATKEY_COLOR_DIFFUSE, colour) == aiReturn_SUCCESS)
        return colour_of(colour);
    return Vertex{}.colour;
}

glm::dvec3 vec(const aiVector3D& v) { return {v.x, v.y, v.z}; }

// A node's transform of points and normals to the model's coordinates.
struct Placement {
    glm::dmat3 linear;
    glm::dvec3 offset;
    glm::dmat3 normals;  // the inverse transpose up to a positive factor; exists even without an inverse

    explicit Placement(const aiMatrix4x4& m)
        : linear(glm::dvec3(m.a1, m.b1, m.c1), glm::dvec3(m.a2, m.b2, m.c2), glm::dvec3(m.a3, m.b3, m.c3)),
          offset(m.a4, m.b4, m.c4),
          normals(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                  glm::cross(linear[0], linear[1])) {
        if (glm::dot(linear[0], normals[0]) < 0) normals = -normals;
    }
};

Status append(Mesh& mesh, const aiScene& scene, const aiMesh& part, const Placement& placement) {
    // A small file can place one mesh any number of times, so limits are checked before growing.
    if (part.mNumVertices > kMaxVertices - mesh.vertices.size())
        return fail("with all its instances it has more than {} vertices", kMaxVertices);
    if (part.mNumFaces > kMaxTriangles - mesh.triangle_count())
        return fail("with all its instances it has more than {} triangles", kMaxTriangles);

    const bool has_colours = part.HasVertexColors(0);
    const Colour paint = part.mMaterialIndex < scene.mNumMaterials
                             ? colour_of(*scene.mMaterials[part.mMaterialIndex])
                             : Vertex{}.colour;
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (unsigned int i = 0; i < part.mNumVertices; ++i) {
        Vertex vertex;
        vertex.position = placement.linear * vec(part.mVertices[i]) + placement.offset;
        if (part.HasNormals()) vertex.normal = pack_normal(placement.normals * vec(part.mNormals[i]));
        vertex.colour = has_colours ? colour_of(part.mColors[0][i]) : paint;
        mesh.vertices.push_back(vertex);
    }
    for (unsigned int f = 0; f < part.mNumFaces; ++f) {
        const aiFace& face = part.mFaces[f];
        if (face.mNumIndices != 3) continue;  // a point or a line
        for (unsigned int corner = 0; corner < 3; ++corner) {
            if (face.mIndices[corner] >= part.mNumVertices)
                return fail("mesh `{}`, face {}: index {}, but there are {} vertices", part.mName.C_Str(), f,
                            face.mIndices[corner], part.mNumVertices);
            mesh.indices.push_back(first + face.mIndices[corner]);
        }
        mesh.materials.push_back(part.mMaterialIndex);
    }
    return {};
}

// Visits nodes depth first, children in order. It does not recurse, because a file can nest nodes as deeply
// as it likes.
Result<Mesh> flatten(const aiScene& scene) {
    struct Visit {
        const aiNode* node;
        aiMatrix4x4 transform;
    };
    Mesh mesh;
    std::vector<Visit> open{{scene.mRootNode, scene.mRootNode->mTransformation}};
    while (!open.empty()) {
        const Visit visit = open.back();
        open.pop_back();
        const Placement placement(visit.transform);
        for (unsigned int i = 0; i < visit.node->mNumMeshes; ++i)
            SWATH_TRY_VOID(append(mesh, scene, *scene.mMeshes[visit.node->mMeshes[i]], placement));
        for (unsigned int i = visit.node->mNumChildren; i > 0; --i) {
            const aiNode* child = visit.node->mChildren[i - 1];
            open.push_back({child, visit.transform * child->mTransformation});
        }
    }
    // A model with one material is the same as one without.
    if (std::ranges::adjacent_find(mesh.materials, std::ranges::not_equal_to()) == mesh.materials.end())
        mesh.materials.clear();
    return mesh;
}

// Assimp's messages may have several lines, ours have one.
std::string one_line(std::string text) {
    std::replace_if(
        text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
    return text.empty() ? "Assimp failed without saying why" : text;
}

}  // namespace

Result<Mesh> read_with_assimp(const std::string& path) {
    try {
        Assimp::Importer importer;
        importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, kUnusedPrimitives);
        importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS, kUnusedComponents);
        const aiScene* scene = importer.ReadFile(path, kSteps);
        if (scene == nullptr) return fail("{}", one_line(importer.GetErrorString()));
        if (scene->mRootNode == nullptr || scene->mNumMeshes == 0) return fail("no triangles");
        return flatten(*scene);
    } catch (const std::exception& exception) {
        return fail("{}", one_line(exception.what()));
    }
}

}  // namespace swath
