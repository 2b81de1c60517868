// solver/scene/mgf_contexts.h
//
// The named vertices, colours and materials of an MGF file, which its statements define and use.

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
  Vec3 xyz = Vec3::Ones();  // the colour in CIE XYZ, scaled so that its luminance Y is 1
};

struct MgfMaterial {
  int sides = 2;
  // The diffuse reflectance and the diffuse emittance of the material.
  Rgb reflectance = Rgb::Zero(), emittance = Rgb::Zero();
  bool specular = false, transmits = false;
};

// All contexts (the named definitions of an MGF file) of one kind: vertices, colours or materials. One of the
// contexts is the current context, which MGF statements use and change.
template <class Value>
class MgfContexts {
 public:
  // Executes an MGF statement `KEY [id [= [template]]]`, which defines or selects the current context;
  // `words` are the words of the statement behind KEY. Throws InputError, without file name and line, for
  // names that are not defined.
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
  // The named contexts of the MGF file; the unnamed context has the key "".
  std::map<std::string, Value, std::less<>> values_;
  std::string name_;
};

}  // namespace penumbra
