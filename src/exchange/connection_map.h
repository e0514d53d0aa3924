// SPDX-FileCopyrightText: 2026 The Enfilade authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "src/exchange/connection_facts.h"

namespace pugi {
class xml_document;
}

namespace enfilade {

/// Draws what FormatConnectionsSvg tells into an empty document.
void DrawConnectionMap(const ConnectionFacts& facts, pugi::xml_document& document);

}  // namespace enfilade
