"""The finished record as files: the page, Markdown, JSON, CSV and figures. Nothing is computed."""
