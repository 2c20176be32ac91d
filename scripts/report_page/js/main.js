// SPDX-License-Identifier: LGPL-2.1-or-later
// Copyright (C) 2026 by the corotet authors

// Starts the page.

async function start() {
  const description = JSON.parse(byId('description').textContent);
  const report = new Report(description);
  // The browser's console can use the report by this name.
  window.report = report;
  if (description.view) {
    try {
      await report.load();
    } catch (error) {
      const hasWebGL = Boolean(document.createElement('canvas').getContext('webgl'));
      byId('loading').textContent = hasWebGL ? `The view cannot be shown: ${error.message}` : 'The view needs a browser with WebGL; all else is below.';
      throw error;
    }
  }
  document.documentElement.dataset.ready = 'true';
}

start();
