#pragma once

#include <abut/clash.h>

#include <array>
#include <string_view>

namespace abut {

inline constexpr std::string_view kMepStructurePreset =
    R"(# Building services against the structure: what the site must not find out by itself.
# Known neighbours are left out; so are contacts up to 10 mm deep, because hangers and sleeves touch.
[[groups]]
name = "services"
select = "discipline = plumbing, hvac, electrical, fire"

[[groups]]
name = "structure"
select = "discipline = structure or type = IfcBeam*, IfcColumn*, IfcSlab*, IfcFooting*, IfcPile*"

[[cells]]
a = "services"
b = "structure"
kinds = ["hard", "contained", "duplicate"]
tolerate = 0.01
severity = "high"
ignore = { neighbours = true }
)";

inline constexpr std::string_view kClearancesPreset =
    R"(# Free space around services: for insulation, for fixing, and for maintenance of equipment.
# The distances are usual ones; write those of your contract into a copy.
[[groups]]
name = "equipment"
select = """type = IfcPump*, IfcFan*, IfcBoiler*, IfcChiller*, IfcUnitaryEquipment*, IfcTank*,
  IfcTransformer*, IfcElectricDistributionBoard*, IfcFlowMovingDevice*, IfcEnergyConversionDevice*,
  IfcFlowStorageDevice*, IfcValve*, IfcDamper*, IfcFlowController*"""

[[groups]]
name = "ducts"
select = "type = IfcDuct* or type = IfcFlowSegment, IfcFlowFitting and discipline = hvac"

[[groups]]
name = "pipes"
select = "type = IfcPipe* or type = IfcFlowSegment, IfcFlowFitting and discipline = plumbing, fire"

[[groups]]
name = "cables"
select = "type = IfcCable* or type = IfcFlowSegment, IfcFlowFitting and discipline = electrical"

[[groups]]
name = "all else"
select = "id = *"

[[cells]]
a = "all else"
b = "all else"
on = false

[[cells]]
a = "equipment"
b = "*"
clearance = 0.6
severity = "medium"
ignore = { neighbours = true }

[[cells]]
a = "ducts"
b = "*"
clearance = 0.05
severity = "low"
ignore = { neighbours = true }

[[cells]]
a = ["pipes", "cables"]
b = "*"
clearance = 0.025
severity = "low"
ignore = { neighbours = true }
)";

inline constexpr std::string_view kArchitecturePreset =
    R"(# Architecture against the other disciplines, and parts that were drawn twice.
# Finishes may reach 5 mm into what they lie on.
[[groups]]
name = "architecture"
select = "discipline = architecture"

[[groups]]
name = "structure"
select = "discipline = structure"

[[groups]]
name = "services"
select = "discipline = plumbing, hvac, electrical, fire"

[[cells]]
a = "architecture"
b = "architecture"
kinds = ["duplicate"]
severity = "low"

[[cells]]
a = "architecture"
b = "structure"
kinds = ["hard", "contained", "duplicate"]
tolerate = 0.005
severity = "medium"
ignore = { neighbours = true }

[[cells]]
a = "architecture"
b = "services"
kinds = ["hard", "contained", "duplicate"]
tolerate = 0.005
severity = "medium"
ignore = { neighbours = true }
)";

/// The files of kMatrixPresets, in their order. docs/schema has copies of them.
inline constexpr std::array<std::string_view, kMatrixPresets.size()> kPresetTexts{
    kMepStructurePreset, kClearancesPreset, kArchitecturePreset};

} // namespace abut
