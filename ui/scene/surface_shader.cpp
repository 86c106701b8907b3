#include "ui/scene/surface_shader.h"

#include <vtkActor.h>
#include <vtkShaderProperty.h>
#include <vtkUniforms.h>

#include <algorithm>
#include <array>
#include <string>

#include "ui/scene/light_map.h"
#include "ui/scene/theme.h"

namespace trapwright::scene {

namespace {

// VTK builds its shaders by replacing marks in templates; ours go in where its lighting would.
constexpr const char* kVertexPlace = "//VTK::PositionVC::Dec\nout vec3 placeInMesh;\n";
constexpr const char* kVertexSetPlace = "//VTK::PositionVC::Impl\nplaceInMesh = vertexMC.xyz;\n";

constexpr const char* kTrackFunctions = R"(
// Shadow and nearness of parts, each as a box or an ellipsoid: x the key light that is left, y the sky.
vec2 lightPastParts(vec3 place, vec3 normal) {
  vec2 left = vec2(1.0);
  for (int i = 0; i < shadeCount; i++) {
    vec3 from = (shadeUnit[i] * vec4(place - shadeCentre[i].xyz, 0.0)).xyz;
    vec3 light = (shadeUnit[i] * vec4(keyInRoom, 0.0)).xyz;
    float near;
    if (shadeCentre[i].w > 0.5) {
      // Slabs (Kay and Kajiya 1986): the millimetres between entry and exit, below zero beside the box.
      vec3 toMiddle = -from / light;
      vec3 toSide = abs(1.0 / light);
      vec3 enter = toMiddle - toSide;
      vec3 leave = toMiddle + toSide;
      float exit = min(leave.x, min(leave.y, leave.z));
      float through = exit - max(enter.x, max(enter.y, enter.z));
      left.x *= 1.0 - smoothstep(-0.9, 1.5, through) * smoothstep(0.0, 0.5, exit);
      near = 1.0 + length(max(abs(from) - 1.0, 0.0));
    } else {
      float length2 = dot(light, light);
      float ahead = -dot(from, light) / length2;
      float miss = length(from + ahead * light);
      left.x *= 1.0 - (1.0 - smoothstep(0.75, 1.2, miss)) * smoothstep(-0.2, 0.4, ahead * sqrt(length2));
      near = max(length(from), 0.9);
    }
    left.y *= 1.0 - 0.7 / (near * near * near);
  }
  return left;
}
)";

constexpr const char* kCommonLight = R"(
  vec3 n = normalize(normalVCVSOutput);
  if (!gl_FrontFacing) n = -n;
  vec3 albedo = pow(diffuseColor, vec3(2.2));
  float sky = 1.0;
  float key = max(dot(n, keyInView), 0.0);
)";

constexpr const char* kTrackLight = R"(
  if (heightShaded > 0) {
    float height = placeInMesh.z - mix(riseAtBegin, riseAtEnd, tcoordVCVSOutput.x);
    albedo = pow(heightColour((height - heightLow) / (heightHigh - heightLow)), vec3(2.2));
    float level = height / 5.0;
    float width = fwidth(level);
    float contour = width > 1e-4 ? 1.0 - smoothstep(0.5 * width, 1.5 * width, abs(level - round(level))) : 0.0;
    albedo *= 1.0 - 0.4 * contour;
  }
  vec2 mapped = texture(lightMap, tcoordVCVSOutput).xy;
  vec2 past = lightPastParts(placeInMesh, n);
  sky *= mapped.x * sqrt(mapped.x) * past.y;
  key *= mapped.y * past.x;
)";

constexpr const char* kFinish = R"(
  float upward = 0.5 + 0.5 * dot(n, upInView);
  vec3 hemisphere = mix(vec3(0.16, 0.155, 0.15), vec3(0.34, 0.36, 0.39), upward) * sky;
  vec3 lit = albedo * (hemisphere + key * vec3(0.78, 0.76, 0.72) + 0.24 * max(n.z, 0.0) * (0.4 + 0.6 * sky));
  // Bright slopes roll off instead of burning out.
  lit = mix(lit, 1.0 - exp(-lit * 1.25), smoothstep(0.6, 1.4, max(lit.r, max(lit.g, lit.b))));
  vec3 shown = pow(clamp(lit, 0.0, 1.0), vec3(1.0 / 2.2));
)";

constexpr const char* kSolid = "  gl_FragData[0] = vec4(shown, opacity);\n";
constexpr const char* kGhost =
    "  float rim = 1.0 - abs(n.z);\n"
    "  gl_FragData[0] = vec4(shown, opacity * (0.45 + 0.55 * rim * rim));\n";

std::array<float, 3> toFloats(const base::Vec3& vector) {
    return {static_cast<float>(vector.x()), static_cast<float>(vector.y()), static_cast<float>(vector.z())};
}

}  // namespace

void setSurfaceShading(vtkActor& actor, SurfaceKind kind) {
    vtkShaderProperty* shader = actor.GetShaderProperty();
    std::string declarations;
    std::string light = kCommonLight;
    if (kind == SurfaceKind::track) {
        shader->AddVertexShaderReplacement("//VTK::PositionVC::Dec", true, kVertexPlace, false);
        shader->AddVertexShaderReplacement("//VTK::PositionVC::Impl", true, kVertexSetPlace, false);
        declarations = "in vec3 placeInMesh;\n" + heightColourShader() + kTrackFunctions;
        light += kTrackLight;
        setHeightRange(actor, false, 0.0, 1.0);
        setRise(actor, 0.0, 0.0);
        setShades(actor, {});
        shader->GetFragmentCustomUniforms()->SetUniform3f("keyInRoom", toFloats(keyLight()).data());
    }
    light += kFinish;
    light += kind == SurfaceKind::ghost ? kGhost : kSolid;
    shader->AddFragmentShaderReplacement("//VTK::Normal::Dec", true, "//VTK::Normal::Dec\n" + declarations,
                                         false);
    shader->AddFragmentShaderReplacement("//VTK::Light::Impl", true, light, false);
    // The light map is no colour: VTK would multiply by it.
    shader->AddFragmentShaderReplacement("//VTK::TCoord::Impl", true, "", false);
    setLights(actor, Camera());
}

void setLights(vtkActor& actor, const Camera& camera) {
    const auto toView = [&camera](const base::Vec3& direction) {
        return toFloats(
            {direction.dot(camera.right()), direction.dot(camera.up()), -direction.dot(camera.forward())});
    };
    vtkUniforms* uniforms = actor.GetShaderProperty()->GetFragmentCustomUniforms();
    uniforms->SetUniform3f("upInView", toView(base::Vec3::UnitZ()).data());
    uniforms->SetUniform3f("keyInView", toView(keyLight()).data());
}

void setHeightRange(vtkActor& actor, bool shaded, double low, double high) {
    vtkUniforms* uniforms = actor.GetShaderProperty()->GetFragmentCustomUniforms();
    uniforms->SetUniformi("heightShaded", shaded ? 1 : 0);
    uniforms->SetUniformf("heightLow", static_cast<float>(low));
    uniforms->SetUniformf("heightHigh", static_cast<float>(high));
}

void setRise(vtkActor& actor, double atBegin, double atEnd) {
    vtkUniforms* uniforms = actor.GetShaderProperty()->GetFragmentCustomUniforms();
    uniforms->SetUniformf("riseAtBegin", static_cast<float>(atBegin));
    uniforms->SetUniformf("riseAtEnd", static_cast<float>(atEnd));
}

void setShades(vtkActor& actor, std::span<const Shade> shades) {
    // The arrays keep their length: another length would be another shader.
    std::array<std::array<float, 16>, kMostShades> toUnit{};
    float centres[kMostShades][4] = {};
    const std::size_t count = std::min(shades.size(), kMostShades);
    for (std::size_t i = 0; i < count; ++i) {
        for (int row = 0; row < 3; ++row) {
            for (int column = 0; column < 3; ++column) {
                const int place = 4 * column + row;
                toUnit[i][static_cast<std::size_t>(place)] =
                    static_cast<float>(shades[i].toUnit(row, column));
            }
            centres[i][row] = static_cast<float>(shades[i].centre[row]);
        }
        centres[i][3] = shades[i].isBox ? 1.0F : 0.0F;
    }
    vtkUniforms* uniforms = actor.GetShaderProperty()->GetFragmentCustomUniforms();
    uniforms->SetUniformi("shadeCount", static_cast<int>(count));
    uniforms->SetUniformMatrix4x4v("shadeUnit", static_cast<int>(kMostShades), toUnit.front().data());
    uniforms->SetUniform4fv("shadeCentre", static_cast<int>(kMostShades), centres);
}

void setInFront(vtkActor& actor) {
    actor.GetShaderProperty()->AddVertexShaderReplacement(
        "//VTK::PositionVC::Impl", true, "//VTK::PositionVC::Impl\ngl_Position.z -= 6e-4 * gl_Position.w;\n",
        false);
}

void setBeforeAll(vtkActor& actor) {
    // The nearest hundredth of the depth is kept for it.
    actor.GetShaderProperty()->AddVertexShaderReplacement(
        "//VTK::PositionVC::Impl", true,
        "//VTK::PositionVC::Impl\ngl_Position.z = 0.01 * gl_Position.z - 0.99 * gl_Position.w;\n", false);
}

}  // namespace trapwright::scene
