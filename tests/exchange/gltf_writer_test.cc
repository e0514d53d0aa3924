// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/exchange/gltf_writer.h"

#include <gtest/gtest.h>
#include <tiny_gltf.h>

#include <cstring>
#include <set>

#include "enfilade/base/errors.h"
#include "enfilade/base/file.h"
#include "enfilade/model/extrude.h"
#include "tests/support/plan_fixtures.h"
#include "tests/support/temp_folder.h"

namespace enfilade {
namespace {

Floorplan TwoRooms() {
  return MakePlan({MakeRoom(0, "0,0 4,0 4,3 0,3"), MakeRoom(5, "4.1,0 7,0 7,2 6,2 6,3 4.1,3")});
}

// Two textures; every face shows the upper left quarter of one of them.
BuildingModel TexturedModel() {
  BuildingModel model = ExtrudeFloorplan(TwoRooms());
  model.textures.emplace_back(16, 32, 3, uint8_t{200});
  model.textures.emplace_back(8, 8, 3, uint8_t{40});
  for (size_t f = 0; f < model.faces.size(); ++f) {
    ModelFace& face = model.faces[f];
    face.texture_idx = static_cast<int>(f % 2);
    for (size_t i = 0; i < face.vertices.size(); ++i) {
      face.uv.emplace_back(0.5 * static_cast<double>(i % 2), 0.5 * static_cast<double>(i / 2 % 2));
    }
  }
  return model;
}

// tinygltf is an independent reader of the format.
tinygltf::Model Load(const std::string& glb) {
  tinygltf::Model model;
  tinygltf::TinyGLTF loader;
  std::string error, warning;
  EXPECT_TRUE(loader.LoadBinaryFromMemory(&model, &error, &warning,
                                          reinterpret_cast<const unsigned char*>(glb.data()),
                                          static_cast<unsigned>(glb.size())));
  EXPECT_EQ(error, "");
  EXPECT_EQ(warning, "");
  return model;
}

std::vector<Eigen::Vector3f> Vectors3(const tinygltf::Model& model, int accessor_idx) {
  const tinygltf::Accessor& accessor = model.accessors.at(static_cast<size_t>(accessor_idx));
  const tinygltf::BufferView& view = model.bufferViews.at(static_cast<size_t>(accessor.bufferView));
  std::vector<Eigen::Vector3f> vectors(accessor.count);
  std::memcpy(vectors.data(), model.buffers[0].data.data() + view.byteOffset, 12 * accessor.count);
  return vectors;
}

const tinygltf::Node& NodeNamed(const tinygltf::Model& model, const std::string& name) {
  for (const tinygltf::Node& node : model.nodes) {
    if (node.name == name) return node;
  }
  ADD_FAILURE() << name;
  return model.nodes.front();
}

TEST(FormatGlb, AnIndependentReaderFindsTheGeometry) {
  const BuildingModel model = ExtrudeFloorplan(TwoRooms());
  const tinygltf::Model read = Load(FormatGlb(model, TwoRooms(), "1.2.3"));
  EXPECT_EQ(read.asset.version, "2.0");
  EXPECT_EQ(read.asset.generator, "Enfilade 1.2.3");
  ASSERT_EQ(read.meshes.size(), model.faces.size());
  for (size_t f = 0; f < model.faces.size(); ++f) {
    const tinygltf::Primitive& primitive = read.meshes[f].primitives.at(0);
    const auto positions = Vectors3(read, primitive.attributes.at("POSITION"));
    const auto normals = Vectors3(read, primitive.attributes.at("NORMAL"));
    ASSERT_EQ(positions.size(), model.faces[f].vertices.size());
    for (size_t i = 0; i < positions.size(); ++i) {
      EXPECT_EQ(positions[i], model.faces[f].vertices[i].cast<float>());
      EXPECT_EQ(normals[i], model.faces[f].normal.cast<float>());
    }
    const tinygltf::Accessor& indices = read.accessors.at(static_cast<size_t>(primitive.indices));
    EXPECT_EQ(indices.count, 3 * model.faces[f].triangles.size());
    EXPECT_EQ(indices.componentType, TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT);
  }
}

TEST(FormatGlb, RootTurnsZUpIntoYUp) {
  const tinygltf::Model read = Load(FormatGlb(ExtrudeFloorplan(TwoRooms()), TwoRooms(), "0"));
  ASSERT_EQ(read.scenes.size(), 1u);
  ASSERT_EQ(read.scenes[0].nodes.size(), 1u);
  const std::vector<double>& q =
      read.nodes.at(static_cast<size_t>(read.scenes[0].nodes[0])).rotation;
  ASSERT_EQ(q.size(), 4u);
  const Eigen::Quaterniond rotation(q[3], q[0], q[1], q[2]);
  EXPECT_NEAR((rotation * Eigen::Vector3d::UnitZ() - Eigen::Vector3d::UnitY()).norm(), 0, 1e-12);
  EXPECT_NEAR((rotation * Eigen::Vector3d::UnitX() - Eigen::Vector3d::UnitX()).norm(), 0, 1e-12);
}

TEST(FormatGlb, RoomNodesCarryTheirFiguresAndSurfaces) {
  const tinygltf::Model read = Load(FormatGlb(ExtrudeFloorplan(TwoRooms()), TwoRooms(), "0"));
  const tinygltf::Node& room = NodeNamed(read, "room_5");
  EXPECT_EQ(room.extras.Get("id").GetNumberAsInt(), 5);
  EXPECT_NEAR(room.extras.Get("area_m2").GetNumberAsDouble(), 7.7, 1e-9);
  EXPECT_NEAR(room.extras.Get("ceiling_z").GetNumberAsDouble(), 2.4, 1e-12);
  std::set<std::string> children;
  for (const int child : room.children)
    children.insert(read.nodes.at(static_cast<size_t>(child)).name);
  EXPECT_EQ(children, (std::set<std::string>{"room_5/floor", "room_5/ceiling", "room_5/wall_4",
                                             "room_5/wall_5", "room_5/wall_6", "room_5/wall_7",
                                             "room_5/wall_8", "room_5/wall_9"}));
}

TEST(FormatGlb, TexturesAreEmbeddedAndUnlit) {
  const tinygltf::Model read = Load(FormatGlb(TexturedModel(), TwoRooms(), "0"));
  ASSERT_EQ(read.images.size(), 2u);
  EXPECT_EQ(read.images[0].mimeType, "image/jpeg");
  EXPECT_EQ(read.images[0].width, 32);
  EXPECT_EQ(read.images[0].height, 16);
  EXPECT_NEAR(read.images[0].image[0], 200, 2);
  EXPECT_NEAR(read.images[1].image[0], 40, 2);
  EXPECT_EQ(read.extensionsUsed, std::vector<std::string>{"KHR_materials_unlit"});
  ASSERT_EQ(read.materials.size(), 2u);
  for (size_t f = 0; f < read.meshes.size(); ++f) {
    const tinygltf::Primitive& primitive = read.meshes[f].primitives.at(0);
    EXPECT_TRUE(primitive.attributes.contains("TEXCOORD_0"));
    const tinygltf::Material& material = read.materials.at(static_cast<size_t>(primitive.material));
    EXPECT_TRUE(material.extensions.contains("KHR_materials_unlit"));
    EXPECT_EQ(material.pbrMetallicRoughness.baseColorTexture.index, static_cast<int>(f % 2));
  }
}

TEST(FormatGlb, ChunksAreAlignedAndLengthsRight) {
  const std::string glb = FormatGlb(TexturedModel(), TwoRooms(), "0.1");
  const auto word = [&](size_t offset) {
    uint32_t value = 0;
    std::memcpy(&value, glb.data() + offset, 4);
    return value;
  };
  EXPECT_EQ(glb.substr(0, 4), "glTF");
  EXPECT_EQ(word(4), 2u);
  EXPECT_EQ(word(8), glb.size());
  EXPECT_EQ(word(12) % 4, 0u);
  const size_t binary = 20 + word(12);
  EXPECT_EQ(word(binary) % 4, 0u);
  EXPECT_EQ(binary + 8 + word(binary), glb.size());
}

TEST(FormatGlb, SameModelSameBytes) {
  EXPECT_EQ(FormatGlb(TexturedModel(), TwoRooms(), "0"),
            FormatGlb(TexturedModel(), TwoRooms(), "0"));
}

TEST(FormatGlb, EmptyModelIsValid) {
  const tinygltf::Model read = Load(FormatGlb({}, {}, "0"));
  EXPECT_EQ(read.nodes.size(), 1u);
}

TEST(FormatGlb, RefusesFacesThatTheCallerGotWrong) {
  BuildingModel model = TexturedModel();
  model.faces[0].texture_idx = 2;
  EXPECT_THROW((void)FormatGlb(model, TwoRooms(), "0"), std::logic_error);
  model = TexturedModel();
  model.faces[0].room_id = 99;
  EXPECT_THROW((void)FormatGlb(model, TwoRooms(), "0"), std::logic_error);
}

TEST(WriteGlb, LeavesNothingWhereItCannotWrite) {
  const TempFolder folder;
  WriteFileAtomic(folder / "file", "x");
  EXPECT_THROW(WriteGlb(folder / "file" / "model.glb", TexturedModel(), TwoRooms(), "0"), IoError);
  WriteGlb(folder / "model.glb", TexturedModel(), TwoRooms(), "0");
  EXPECT_EQ(ReadFile(folder / "model.glb"), FormatGlb(TexturedModel(), TwoRooms(), "0"));
}

TEST(WriteGlb, FullDiskIsAnIoError) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  const TempFolder folder;
  // The temporary file of the atomic write would be made beside the link, so the device itself
  // stands in for a folder that takes no files.
  EXPECT_THROW(WriteGlb("/dev/full/model.glb", TexturedModel(), TwoRooms(), "0"), IoError);
}

}  // namespace
}  // namespace enfilade
