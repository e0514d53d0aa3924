// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#include "enfilade/exchange/connection_report.h"

#include <nlohmann/json.hpp>
#include <pugixml.hpp>

#include "enfilade/base/file.h"
#include "enfilade/base/json.h"
#include "src/exchange/connection_facts.h"
#include "src/exchange/connection_json.h"
#include "src/exchange/connection_map.h"
#include "src/exchange/connection_page.h"
#include "src/exchange/svg_elements.h"

namespace enfilade {
namespace {

std::string FormatMap(const ConnectionFacts& facts) {
  pugi::xml_document document;
  DrawConnectionMap(facts, document);
  return FormatXml(document);
}

std::string FormatPage(const ConnectionFacts& facts) {
  pugi::xml_document document;
  BuildConnectionPage(facts, document);
  return FormatXml(document);
}

}  // namespace

std::string FormatConnectionsSvg(const Scene& scene, const ConnectionReport& report) {
  return FormatMap(CollectConnectionFacts(scene, report));
}

std::string FormatConnectionsHtml(const Scene& scene, const ConnectionReport& report) {
  return FormatPage(CollectConnectionFacts(scene, report));
}

void WriteConnectionReport(const std::filesystem::path& folder, const Scene& scene,
                           const ConnectionReport& report) {
  const ConnectionFacts facts = CollectConnectionFacts(scene, report);
  WriteJsonFile(folder / "connections.json", ConnectionsToJson(facts));
  WriteFileAtomic(folder / "connections.svg", FormatMap(facts));
  WriteFileAtomic(folder / "connections.html", FormatPage(facts));
}

}  // namespace enfilade
