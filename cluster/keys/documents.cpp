#include "cluster/keys/documents.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <span>

namespace vindu {
namespace {

// Which of DDS' domains a wall uses is in its wall file; a name that is on nobody's certificate
// protects, not a number.
constexpr const char* kDomains =
    "<domains><id_range><min>0</min><max>230</max></id_range></domains>";

std::string document(const std::string& kind, const std::string& content) {
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<dds xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\" "
      "xsi:noNamespaceSchemaLocation=\"http://www.omg.org/spec/DDS-Security/20170801/"
      "omg_shared_ca_{}.xsd\">\n{}</dds>\n",
      kind, content);
}

/// Topics are "v1/frame": their rights outlive a version of the messages.
std::string topics(const std::string& what, Topics which, std::span<const Role> marks) {
  std::string names;
  for (const Role role : marks) names += fmt::format("        <topic>{}</topic>\n", mark_of(role));
  for (int i = 0; i < kTopics; ++i)
    if (const auto topic = static_cast<Topic>(i); which.has(topic))
      names += fmt::format("        <topic>v*/{}</topic>\n", rules_of(topic).name);
  if (names.empty()) return {};
  return fmt::format("      <{0}>\n       <topics>\n{1}       </topics>\n      </{0}>\n", what,
                     names);
}

std::string time_text(std::chrono::system_clock::time_point time) {
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}",
                     fmt::gmtime(std::chrono::system_clock::to_time_t(time)));
}

}  // namespace

std::string governance_document() {
  return document("governance", fmt::format(R"( <domain_access_rules>
  <domain_rule>
   {}
   <allow_unauthenticated_participants>false</allow_unauthenticated_participants>
   <enable_join_access_control>true</enable_join_access_control>
   <discovery_protection_kind>ENCRYPT</discovery_protection_kind>
   <liveliness_protection_kind>SIGN</liveliness_protection_kind>
   <rtps_protection_kind>ENCRYPT_WITH_ORIGIN_AUTHENTICATION</rtps_protection_kind>
   <topic_access_rules>
    <topic_rule>
     <topic_expression>*</topic_expression>
     <enable_discovery_protection>true</enable_discovery_protection>
     <enable_liveliness_protection>true</enable_liveliness_protection>
     <enable_read_access_control>true</enable_read_access_control>
     <enable_write_access_control>true</enable_write_access_control>
     <metadata_protection_kind>NONE</metadata_protection_kind>
     <data_protection_kind>NONE</data_protection_kind>
    </topic_rule>
   </topic_access_rules>
  </domain_rule>
 </domain_access_rules>
)",
                                            kDomains));
}

std::string permissions_document(const std::string& subject, Role role, const Validity& validity) {
  const TopicRights rights = rights_of(role);
  std::span<const Role> watched;
  if (rights.reads.has(Topic::tile_status)) watched = kRoles;
  return document("permissions",
                  fmt::format(R"( <permissions>
  <grant name="vindu">
   <subject_name>{}</subject_name>
   <validity>
    <not_before>{}</not_before>
    <not_after>{}</not_after>
   </validity>
   <allow_rule>
    {}
{}{}   </allow_rule>
   <default>DENY</default>
  </grant>
 </permissions>
)",
                              subject, time_text(validity.from), time_text(validity.until),
                              kDomains, topics("publish", rights.writes, {&role, 1}),
                              topics("subscribe", rights.reads, watched)));
}

}  // namespace vindu
