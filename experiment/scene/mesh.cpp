#include "experiment/scene/mesh.h"

namespace overt {

namespace {

double area_of(const Mesh& mesh, const glm::uvec3& triangle) {
    const glm::dvec3 a(mesh.positions[triangle.x]), b(mesh.positions[triangle.y]),
        c(mesh.positions[triangle.z]);
    return 0.5 * glm::length(glm::cross(b - a, c - a));
}

} // namespace

Bounds Mesh::bounds() const {
    if (positions.empty())
        return {};
    Bounds box{glm::dvec3(positions.front()), glm::dvec3(positions.front())};
    for (const glm::vec3& position : positions) {
        box.min = glm::min(box.min, glm::dvec3(position));
        box.max = glm::max(box.max, glm::dvec3(position));
    }
    return box;
}

std::vector<glm::vec3> Mesh::vertex_normals() const {
    std::vector<glm::dvec3> sums(positions.size(), glm::dvec3(0.0));
    for (const glm::uvec3& triangle : triangles) {
        const glm::dvec3 a(positions[triangle.x]), b(positions[triangle.y]), c(positions[triangle.z]);
        // The cross product's length is twice the area, which is the weight wanted.
        const glm::dvec3 weighted = glm::cross(b - a, c - a);
        for (int corner = 0; corner < 3; ++corner)
            sums[triangle[corner]] += weighted;
    }
    std::vector<glm::vec3> normals(sums.size());
    for (std::size_t i = 0; i < sums.size(); ++i) {
        const double length = glm::length(sums[i]);
        normals[i] = length > 0.0 ? glm::vec3(sums[i] / length) : glm::vec3(0.0f, 0.0f, 1.0f);
    }
    return normals;
}

double Mesh::area() const {
    double sum = 0.0;
    for (const glm::uvec3& triangle : triangles)
        sum += area_of(*this, triangle);
    return sum;
}

std::vector<double> Mesh::part_areas() const {
    std::vector<double> sums(part_names.size(), 0.0);
    for (std::size_t i = 0; i < triangles.size(); ++i)
        sums[triangle_parts[i]] += area_of(*this, triangles[i]);
    return sums;
}

} // namespace overt
