// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <map>
#include <pugixml.hpp>
#include <string>
#include <vector>

namespace enfilade {

/// The document, which must be well-formed.
inline pugi::xml_document ParseXml(const std::string& xml) {
  pugi::xml_document document;
  const pugi::xml_parse_result result = document.load_string(xml.c_str(), pugi::parse_full);
  EXPECT_TRUE(result) << result.description() << " at " << result.offset;
  return document;
}

/// The nodes that an XPath query finds.
inline std::vector<pugi::xml_node> Select(const pugi::xml_document& document,
                                          const std::string& query) {
  std::vector<pugi::xml_node> nodes;
  for (const pugi::xpath_node& hit : document.select_nodes(query.c_str())) {
    nodes.push_back(hit.node());
  }
  return nodes;
}

/// Where the cameras of a drawing of connections are, by picture.
inline std::map<std::string, Eigen::Vector2d> CamerasOf(const pugi::xml_document& document) {
  std::map<std::string, Eigen::Vector2d> cameras;
  for (const pugi::xml_node& node : Select(document, "//circle[@data-picture]")) {
    cameras[node.attribute("data-picture").value()] = {node.attribute("cx").as_double(),
                                                       node.attribute("cy").as_double()};
  }
  return cameras;
}

}  // namespace enfilade
