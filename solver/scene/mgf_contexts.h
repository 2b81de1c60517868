// solver/scene/mgf_contexts.h
//
// The vertices, colours and materials that the statements of an MGF file define and refer to.

#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>

#include "solver/base/check.h"
#include "solver/geometry/vec.h"
#include "solver/scene/text_reader.h"

namespace penumbra {

struct MgfVertex {
  Vec3 position = Vec3::Zero(), normal = Vec3::Zero();
};

struct MgfColour {
  Vec3 xyz = Vec3::Ones();  // of luminance 1
};

struct MgfMaterial {
  int sides = 2;
  Rgb reflectance = Rgb::Zero(), emittance = Rgb::Zero();  // diffuse
  bool specular = false, transmits = false;
};

// All contexts of one kind, one of which is current.
template <class Value>
class MgfContexts {
 public:
  // Obeys `KEY [id [= [template]]]`; `words` are those behind the key. Throws InputError, without a place,
  // for names that are not defined.
  void Select(std::span<const std::string_view> words) {
    if (words.size() > 3 || (words.size() > 1 && words[1] != "="))
      throw InputError("it takes [NAME [= [TEMPLATE]]]");
    name_ = words.empty() ? "" : std::string(words[0]);
    if (words.size() == 1) {
      Find(words[0]);
      return;
    }
    values_[name_] = words.size() == 3 ? Find(words[2]) : Value();
  }

  Value& Current() { return values_[name_]; }
  const std::string& CurrentName() const { return name_; }

  const Value& Find(std::string_view name) const {
    const auto found = values_.find(name);
    if (found == values_.end()) throw InputError(Quoted(name) + " is not defined; define it above");
    return found->second;
  }

 private:
  std::map<std::string, Value, std::less<>> values_;  // the unnamed one under ""
  std::string name_;
};

}  // namespace penumbra
