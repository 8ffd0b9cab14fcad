#include "experiment/study/template/object_landmarks.h"

namespace overt {

namespace {

/// The middle of each named area, in mm: of its triangles by their areas.
LandmarksByName area_middles(const StudyObject& object) {
    LandmarksByName middles;
    const Mesh& mesh = *object.mesh;
    for (std::size_t area = 0; area < object.areas.size(); ++area) {
        glm::dvec3 sum(0.0);
        double all = 0.0;
        for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
            if (!object.areas.holds(area, mesh.triangle_parts[t]))
                continue;
            const glm::uvec3& of = mesh.triangles[t];
            const glm::dvec3 a(mesh.positions[of.x]), b(mesh.positions[of.y]), c(mesh.positions[of.z]);
            const double size = 0.5 * glm::length(glm::cross(b - a, c - a));
            sum += size * (a + b + c) / 3.0;
            all += size;
        }
        if (all > 0.0 && object.areas.names()[area] != rest_part)
            middles[object.areas.names()[area]] = sum / all * *object.mm_per_unit;
    }
    return middles;
}

} // namespace

LandmarksByName landmarks_of(const StudyObject& object, const TemplateChoice& choice) {
    if (choice.lists.empty() && choice.landmarks.empty())
        return area_middles(object);
    LandmarksByName found;
    for (const std::string& list : choice.lists)
        for (const NamedPlace& point : object.points)
            if (point.name.starts_with(list + "."))
                found[point.name] = point.position * *object.mm_per_unit;
    for (const Landmark& landmark : choice.landmarks)
        if (landmark.object == object.id)
            found[landmark.name] = landmark.place_mm;
    return found;
}

} // namespace overt
