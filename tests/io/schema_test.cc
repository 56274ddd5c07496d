// The schema and the reader say the same about a case.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "emmy/io/case_file.h"
#include "emmy/io/case_keys.h"
#include "emmy/model/model_builder.h"
#include "tests/io/sample_case.h"
#include "tests/support/schema_checker.h"

namespace emmy {
namespace {

using nlohmann::json;
using ::testing::UnorderedElementsAreArray;

const json& Schema() {
  static const json& schema = *new json(json::parse(
      std::ifstream(EMMY_SOURCE_DIR "/lib/emmy/io/case.schema.json")));
  return schema;
}

const std::vector<ObjectKeys>& AllKeys() {
  static const auto& keys = *new std::vector<ObjectKeys>{
      kCaseKeys,        kRigidBodyKeys,   kBoxKeys,        kInertiaKeys,
      kOrientationKeys, kNodeKeys,        kMovesWithKeys,  kBodyPointKeys,
      kNodePointKeys,   kGroundPointKeys, kTrussKeys,      kSpringKeys,
      kForceKeys,       kTorqueKeys,      kIntegratorKeys, kOutputKeys};
  return keys;
}

template <typename Array>
std::vector<std::string> Names(const Array& keys) {
  std::vector<std::string> names;
  for (const auto key : keys) {
    if (!key.empty()) names.emplace_back(key);
  }
  return names;
}

std::vector<std::string> Keys(const json& object) {
  std::vector<std::string> keys;
  for (const auto& member : object.items()) keys.push_back(member.key());
  return keys;
}

// Calls `visit(pointer)` for every value inside `value`.
template <typename Visit>
void ForEachPlace(const json& value, const json::json_pointer& here,
                  const Visit& visit) {
  if (!here.empty()) visit(here);
  if (value.is_object()) {
    for (const auto& member : value.items()) {
      ForEachPlace(member.value(), here / member.key(), visit);
    }
  } else if (value.is_array()) {
    for (size_t i = 0; i < value.size(); ++i) {
      ForEachPlace(value[i], here / i, visit);
    }
  }
}

bool ReaderAccepts(const json& value) { return ParseCase(value.dump()).ok(); }

class SchemaTest : public ::testing::Test {
 protected:
  void ExpectSameVerdict(const json& value, const std::string& change) {
    const bool by_schema = SchemaChecker(Schema()).IsValid(value);
    const absl::StatusOr<Case> by_reader = ParseCase(value.dump());
    EXPECT_EQ(by_schema, by_reader.ok())
        << change << ": the reader says: " << by_reader.status();
    accepted_ += by_schema ? 1 : 0;
    rejected_ += by_schema ? 0 : 1;
  }

  const json sample_ = json::parse(kSampleCase);
  int accepted_ = 0;
  int rejected_ = 0;
};

TEST_F(SchemaTest, EveryObjectHasTheKeysOfTheReader) {
  for (const ObjectKeys& keys : AllKeys()) {
    const std::string kind(keys.kind);
    ASSERT_TRUE(Schema()["$defs"].contains(kind)) << kind;
    const json& object = Schema()["$defs"][kind];
    std::vector<std::string> known = Names(keys.required);
    for (const std::string& key : Names(keys.optional)) known.push_back(key);
    EXPECT_THAT(Keys(object["properties"]), UnorderedElementsAreArray(known))
        << kind;
    const std::vector<std::string> required =
        object.value("required", std::vector<std::string>());
    EXPECT_THAT(required, UnorderedElementsAreArray(Names(keys.required)))
        << kind;
    EXPECT_EQ(object["additionalProperties"], false) << kind;
  }
}

TEST_F(SchemaTest, TheReaderKnowsEveryObjectOfTheSchema) {
  for (const auto& definition : Schema()["$defs"].items()) {
    if (!definition.value().contains("properties")) continue;
    EXPECT_TRUE(std::any_of(AllKeys().begin(), AllKeys().end(),
                            [&](const ObjectKeys& keys) {
                              return std::string(keys.kind) == definition.key();
                            }))
        << definition.key();
  }
}

TEST_F(SchemaTest, TheSampleUsesEveryKey) {
  std::vector<std::string> used;
  ForEachPlace(
      sample_, json::json_pointer(),
      [&](const json::json_pointer& place) { used.push_back(place.back()); });
  for (const ObjectKeys& keys : AllKeys()) {
    for (const std::string& key : Names(keys.required)) {
      EXPECT_THAT(used, ::testing::Contains(key));
    }
    for (const std::string& key : Names(keys.optional)) {
      EXPECT_THAT(used, ::testing::Contains(key));
    }
  }
}

TEST_F(SchemaTest, AcceptsTheSampleAndTheReaderDoesToo) {
  ExpectSameVerdict(sample_, "nothing");
  EXPECT_EQ(accepted_, 1);
}

TEST_F(SchemaTest, AgreesWithTheReaderWhenAnyValueIsMissing) {
  ForEachPlace(
      sample_, json::json_pointer(), [&](const json::json_pointer& place) {
        json changed = sample_;
        json& parent = changed[place.parent_pointer()];
        if (parent.is_object()) {
          parent.erase(place.back());
        } else {
          parent.erase(static_cast<size_t>(std::stoi(place.back())));
        }
        // Which bodies have a penalty and that there are bodies at all
        // is checked when the model is built.
        if (place.back() == "penalty" || place.back() == "formulation") {
          return;
        }
        ExpectSameVerdict(changed, "without " + place.to_string());
      });
  EXPECT_GT(accepted_, 20);
  EXPECT_GT(rejected_, 100);
}

TEST_F(SchemaTest, AgreesWithTheReaderWhenAnyValueHasAnotherType) {
  const std::vector<json> others = {nullptr,          true,
                                    "text",           json::array(),
                                    json::object(),   json::array({1, 2, 3}),
                                    json::array({1}), {{"key", 1}}};
  ForEachPlace(
      sample_, json::json_pointer(), [&](const json::json_pointer& place) {
        for (const json& other : others) {
          json changed = sample_;
          changed[place] = other;
          if (place.to_string() == "/rigid_bodies" && other.empty()) continue;
          ExpectSameVerdict(changed, place.to_string() + " = " + other.dump());
        }
      });
  EXPECT_GT(accepted_, 40);
  EXPECT_GT(rejected_, 1000);
}

TEST_F(SchemaTest, AgreesWithTheReaderWhenAnyObjectHasAKeyTooMany) {
  std::vector<std::string> keys = {"unknown", "", "Name"};
  for (const ObjectKeys& object : AllKeys()) {
    for (const std::string& key : Names(object.required)) keys.push_back(key);
    for (const std::string& key : Names(object.optional)) keys.push_back(key);
  }
  ForEachPlace(sample_, json::json_pointer(),
               [&](const json::json_pointer& place) {
                 if (!sample_[place].is_object()) return;
                 for (const std::string& key : keys) {
                   json changed = sample_;
                   if (changed[place].contains(key)) continue;
                   changed[place][key] = json::array({0.5, 0.5, 0.5});
                   // See above; and a box has no second inertia of this type.
                   if (key == "penalty") continue;
                   ExpectSameVerdict(changed, place.to_string() + "/" + key);
                 }
               });
  EXPECT_GT(rejected_, 500);
}

TEST_F(SchemaTest, RejectsTheControlCharactersInNamesThatTheModelRejects) {
  const json node = json::parse(R"({
    "format": "emmy-case/1", "name": "n", "nodes": [{"name": "n", "mass": 1}],
    "integrator": {"method": "energy_momentum", "time_step": 1, "duration": 1}
  })");
  for (int c = 0; c < 0x100; ++c) {
    std::string character(1, static_cast<char>(c));
    if (c >= 0x80) {
      character = {static_cast<char>(0xC0 | (c >> 6)),
                   static_cast<char>(0x80 | (c & 0x3F))};
    }
    for (const char* after : {"", "x"}) {
      json changed = node;
      changed["nodes"][0]["name"] = absl::StrCat("x", character, after);
      const absl::StatusOr<Case> read = ParseCase(changed.dump());
      ASSERT_TRUE(read.ok());
      EXPECT_EQ(SchemaChecker(Schema()).IsValid(changed),
                BuildModel(read->model).ok())
          << "character " << c;
    }
  }
  // Whose bytes are those of control characters in part.
  json changed = node;
  changed["nodes"][0]["name"] = "„Knöten“ 日本 😀";
  EXPECT_TRUE(SchemaChecker(Schema()).IsValid(changed));
  EXPECT_TRUE(BuildModel(ParseCase(changed.dump())->model).ok());
}

// What the schema says of ranges, the reader or the model builder says too.
TEST_F(SchemaTest, WhatTheSchemaFindsOutOfRangeIsRejected) {
  const json box = json::parse(R"({
    "format": "emmy-case/1", "name": "box",
    "rigid_bodies": [{"name": "box", "penalty": [1, 1, 1, 1, 1, 1],
                      "box": {"size": [3, 2, 1], "density": 2700}},
                     {"name": "top", "formulation": "conventional",
                      "start": "undeformed",
                      "inertia": {"mass": 1, "tensor": [1, 1, 1],
                                  "volume": 1}}],
    "integrator": {"method": "energy_momentum", "time_step": 1e-3,
                   "duration": 1, "order": 2, "tolerance": 0.1},
    "output": {"every": 1}})");
  int out_of_range = 0;
  ForEachPlace(box, json::json_pointer(), [&](const json::json_pointer& place) {
    for (const json& number : {json(0), json(-1), json(0.5), json(2)}) {
      json changed = box;
      if (!changed[place].is_number()) return;
      changed[place] = number;
      if (SchemaChecker(Schema()).IsValid(changed)) continue;
      ++out_of_range;
      const absl::StatusOr<Case> result = ParseCase(changed.dump());
      EXPECT_FALSE(result.ok() && BuildModel(result->model).ok())
          << place.to_string() << " = " << number;
    }
  });
  EXPECT_GT(out_of_range, 20);
}

TEST_F(SchemaTest, AcceptsEveryExampleAndTheReaderDoesToo) {
  int examples = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(EMMY_SOURCE_DIR "/examples")) {
    if (entry.path().extension() != ".json") continue;
    ++examples;
    const json value = json::parse(std::ifstream(entry.path()));
    EXPECT_TRUE(SchemaChecker(Schema()).IsValid(value)) << entry.path();
    EXPECT_TRUE(ReaderAccepts(value)) << entry.path();
    EXPECT_EQ(value["name"], entry.path().stem().string());
    EXPECT_NE(value["purpose"], "") << entry.path();
  }
  EXPECT_GE(examples, 8);
}

}  // namespace
}  // namespace emmy
