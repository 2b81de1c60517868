#include "display/walkthrough/html_writer.h"

#include <fmt/format.h>

#include "display/base64.h"
#include "display/walkthrough/embedded_page.h"
#include "display/walkthrough/page_data.h"
#include "solver/base/check.h"

namespace penumbra {
namespace {

std::string_view PageFile(std::string_view name) {
  for (const EmbeddedFile& file : EmbeddedPageFiles())
    if (file.name == name) return file.text;
  throw std::logic_error(fmt::format("the page has no file '{}'", name));
}

// Replaces the text that must occur in the page.
void Replace(std::string_view what, std::string_view by, std::string* page) {
  const std::size_t at = page->find(what);
  PENUMBRA_CHECK(at != std::string::npos);
  page->replace(at, what.size(), by);
}

// The page with the texts of the files to which its tags <link> and <script src> refer.
std::string WithTheFiles(std::string page) {
  constexpr std::string_view kLink = "<link rel=\"stylesheet\" href=\"", kSource = " src=\"";
  for (std::size_t at = page.find(kLink); at != std::string::npos; at = page.find(kLink, at)) {
    const std::size_t name = at + kLink.size(), quote = page.find('"', name);
    const std::string style =
        fmt::format("<style>\n{}</style>", PageFile(std::string_view(page).substr(name, quote - name)));
    page.replace(at, quote + 2 - at, style);
  }
  for (std::size_t at = page.find(kSource); at != std::string::npos; at = page.find(kSource, at)) {
    const std::size_t name = at + kSource.size(), quote = page.find('"', name);
    const std::string script =
        fmt::format(">\n{}", PageFile(std::string_view(page).substr(name, quote - name)));
    page.replace(at, quote + 2 - at, script);
  }
  return page;
}

class HtmlWriter final : public MeshWriter {
 public:
  bool HasColours() const override { return true; }
  bool HasCamera() const override { return true; }
  std::string Bytes(const MeshExport& from) const override {
    const PageData data = MakePageData(from);
    std::string page = WithTheFiles(std::string(PageFile("page.html")));
    Replace("{{data}}", Base64(data.arrays), &page);
    Replace("{{description}}", data.description, &page);  // last: names may hold any text but `<`
    return page;
  }
};

}  // namespace

MeshWriterRegistry::Method HtmlWriterMethod() {
  return {
      "html",
      "a page to walk through the light, in one file: the interpolants, evaluated at every pixel by WebGL 2",
      {},
      [] { return std::make_unique<const HtmlWriter>(); }};
}

}  // namespace penumbra
